// Where the base was when.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

/// The base at one time, in the map frame.
struct TrajectoryPoint {
  double time_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double yaw_rad = 0.0;  ///< not wrapped: it runs on over full turns

  bool operator==(const TrajectoryPoint&) const = default;
};

/// T_map_base at a time, linear between points in the order of their times; before the first and
/// after the last it stands.
Transform T_map_base_at(std::span<const TrajectoryPoint> points, double time_s);

/// A recorded drive.
class Trajectory {
 public:
  /// Throws InputError unless there is a point, all numbers are finite, times start at 0 and grow.
  explicit Trajectory(std::vector<TrajectoryPoint> points);

  /// Goes on to a later point. Throws InputError unless its numbers are finite and its time grows.
  void append(const TrajectoryPoint& point);

  const std::vector<TrajectoryPoint>& points() const { return points_; }
  double duration_s() const { return points_.back().time_s; }
  double length_m() const;  ///< of the way in the plane

  /// As T_map_base_at().
  Transform T_map_base(double time_s) const { return T_map_base_at(points_, time_s); }

 private:
  std::vector<TrajectoryPoint> points_;
};

/// A CSV file with the header time_s,x_m,y_m,z_m,yaw_rad and a line a point. Writing is atomic and
/// keeps every bit of the numbers: what is read equals what was written. Reading throws InputError
/// that names file, line and fault.
Trajectory read_trajectory(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
Trajectory parse_trajectory(const std::string& csv, const std::string& name);
void write_trajectory(const Trajectory& trajectory, const std::filesystem::path& path);

}  // namespace nbvopt
