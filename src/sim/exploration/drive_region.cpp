#include "sim/exploration/drive_region.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

DriveRegion::DriveRegion(const ExplorationOptions& options)
    : corners_map_m_(options.region_map_m), near_world_map_m_(options.world_map_m) {
  if (!corners_map_m_.empty() && corners_map_m_.size() < 3) {
    throw InputError("the region has " + std::to_string(corners_map_m_.size()) +
                     " corners, it must have at least 3");
  }
  if (!std::ranges::all_of(corners_map_m_, [](const auto& corner) { return corner.allFinite(); })) {
    throw InputError("a corner of the region is not finite, give x and y in metres");
  }
  if (near_world_map_m_.isEmpty()) return;
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(options.mapping_range_m);
  near_world_map_m_.min() -= reach;
  near_world_map_m_.max() += reach;
}

bool DriveRegion::contains(const Eigen::Vector2d& position_map_m) const {
  if (corners_map_m_.empty()) return true;
  bool is_inside = false;  // of an odd number of edges to the right
  for (std::size_t i = 0; i < corners_map_m_.size(); ++i) {
    const Eigen::Vector2d& a = corners_map_m_[i];
    const Eigen::Vector2d& b = corners_map_m_[(i + 1) % corners_map_m_.size()];
    if ((a.y() > position_map_m.y()) == (b.y() > position_map_m.y())) continue;
    const double x = a.x() + (b.x() - a.x()) * (position_map_m.y() - a.y()) / (b.y() - a.y());
    if (position_map_m.x() < x) is_inside = !is_inside;
  }
  return is_inside;
}

bool DriveRegion::is_open_ground(const Eigen::Vector2d& position_map_m) const {
  return corners_map_m_.empty() && !near_world_map_m_.isEmpty() &&
         !near_world_map_m_.contains(position_map_m);
}

}  // namespace nbvopt
