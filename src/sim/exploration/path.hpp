// A way in the plane.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace nbvopt {

/// Straight pieces from point to point in the map, addressed by the distance along them.
class Path {
 public:
  /// At least one point.
  explicit Path(std::vector<Eigen::Vector2d> points_map_m);

  std::span<const Eigen::Vector2d> points_map_m() const { return points_map_m_; }

  /// How far along the path each point is.
  std::span<const double> along_m() const { return along_m_; }

  double length_m() const { return along_m_.back(); }

  /// The point at a distance along the path, clamped to its ends.
  Eigen::Vector2d point_at(double along_m) const;

  /// The distance along the path, within [from, to], of the point nearest to a position.
  double nearest_m(const Eigen::Vector2d& position_map_m, double from_m, double to_m) const;

  /// What lies ahead: the point at this distance along the path, then all later corners.
  std::vector<Eigen::Vector2d> rest(double along_m) const;

 private:
  /// The first point, never the path's own first, beyond a distance that is less than the length.
  std::size_t next_point(double along_m) const;

  std::vector<Eigen::Vector2d> points_map_m_;
  std::vector<double> along_m_;  // of each point
};

}  // namespace nbvopt
