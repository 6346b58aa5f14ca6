#include "sim/exploration/volume/frontier_slice.hpp"

#include <algorithm>

namespace nbvopt {

std::vector<Eigen::Vector2d> slice_frontiers(const VoxelGrid& grid, const KeyBox& box,
                                             std::uint16_t layer, bool looks_both_ways) {
  const auto state = [&](int x, int y) {
    return grid.state({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), layer});
  };
  const auto is_unknown = [&](int x, int y) { return state(x, y) == VoxelState::unknown; };
  std::vector<Eigen::Vector2d> points_map_m;
  for (int y = box.min.y; y <= box.max.y; ++y) {
    for (int x = box.min.x; x <= box.max.x; ++x) {
      if (state(x, y) != VoxelState::free) continue;
      const bool is_frontier = is_unknown(x - 1, y) || is_unknown(x, y - 1) ||
                               (looks_both_ways && (is_unknown(x + 1, y) || is_unknown(x, y + 1)));
      if (!is_frontier) continue;
      const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), layer};
      points_map_m.emplace_back(grid.lattice().centre_m(key).head<2>());
    }
  }
  return points_map_m;
}

std::vector<FrontierGroup> group_frontiers(std::span<const Eigen::Vector2d> points_map_m,
                                           double radius_m) {
  std::vector<FrontierGroup> groups;
  for (const Eigen::Vector2d& point : points_map_m) {
    const auto near = std::ranges::find_if(groups, [&](const FrontierGroup& group) {
      return (group.points_map_m.front() - point).norm() <= radius_m;
    });
    if (near == groups.end()) {
      groups.push_back({{point}});
    } else {
      near->points_map_m.push_back(point);
    }
  }
  return groups;
}

}  // namespace nbvopt
