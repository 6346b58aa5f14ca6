#include "sim/exploration/path.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace nbvopt {

Path::Path(std::vector<Eigen::Vector2d> points_map_m)
    : points_map_m_(std::move(points_map_m)), along_m_{0.0} {
  for (std::size_t i = 1; i < points_map_m_.size(); ++i) {
    along_m_.push_back(along_m_.back() + (points_map_m_[i] - points_map_m_[i - 1]).norm());
  }
}

std::size_t Path::next_point(double along_m) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(along_m_, std::max(along_m, 0.0)) -
                                  along_m_.begin());
}

Eigen::Vector2d Path::point_at(double along_m) const {
  if (along_m >= length_m()) return points_map_m_.back();
  const double clamped_m = std::max(along_m, 0.0);
  const std::size_t next = next_point(clamped_m);
  const double part = (clamped_m - along_m_[next - 1]) / (along_m_[next] - along_m_[next - 1]);
  return points_map_m_[next - 1] + part * (points_map_m_[next] - points_map_m_[next - 1]);
}

double Path::nearest_m(const Eigen::Vector2d& position_map_m, double from_m, double to_m) const {
  double nearest_m = from_m;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points_map_m_.size(); ++i) {
    if (along_m_[i + 1] < from_m || along_m_[i] > to_m || along_m_[i + 1] == along_m_[i]) continue;
    const Eigen::Vector2d direction =
        (points_map_m_[i + 1] - points_map_m_[i]) / (along_m_[i + 1] - along_m_[i]);
    const double along_m =
        std::clamp(along_m_[i] + direction.dot(position_map_m - points_map_m_[i]),
                   std::max(from_m, along_m_[i]), std::min(to_m, along_m_[i + 1]));
    const Eigen::Vector2d point = points_map_m_[i] + (along_m - along_m_[i]) * direction;
    const double distance = (point - position_map_m).squaredNorm();
    if (distance < least) {
      least = distance;
      nearest_m = along_m;
    }
  }
  return nearest_m;
}

std::vector<Eigen::Vector2d> Path::rest(double along_m) const {
  if (along_m >= length_m()) return {points_map_m_.back()};
  std::vector<Eigen::Vector2d> points{point_at(along_m)};
  points.insert(points.end(),
                points_map_m_.begin() + static_cast<std::ptrdiff_t>(next_point(along_m)),
                points_map_m_.end());
  return points;
}

}  // namespace nbvopt
