// How a base moves along a path, and turns.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/path.hpp"

namespace nbvopt {

/// An omnidirectional base that follows paths within its limits. It turns its x axis to where it
/// drives, since that is where a camera on it looks, and slows down until it has.
class BaseMotion {
 public:
  BaseMotion(const BaseOptions& options, const Eigen::Vector2d& position_map_m, double yaw_rad);

  /// Takes a new path, which starts about where the base is.
  void follow(Path path);

  /// Turns on the spot to a yaw, which is not wrapped, the way that it is off by.
  void turn_to(double yaw_rad);

  /// Brakes and stands.
  void halt();

  /// Moves for one short time: velocities change by what the accelerations allow, then positions
  /// by the new velocities. So the limits hold for differences between samples, exactly.
  void step(double time_s);

  const Eigen::Vector2d& position_map_m() const { return position_map_m_; }
  double yaw_rad() const { return yaw_rad_; }  ///< not wrapped

  const std::optional<Path>& path() const { return path_; }
  double along_path_m() const { return along_path_m_; }

  /// Whether the path's end is as near as a base needs to be; also when there is no path.
  bool has_arrived() const;
  /// Whether it looks to where it was told to turn, as near as it needs to; also when it was not.
  bool has_turned() const;
  bool stands() const;

 private:
  BaseOptions options_;
  Eigen::Vector2d position_map_m_;
  Eigen::Vector2d velocity_map_m_s_ = Eigen::Vector2d::Zero();
  double yaw_rad_;
  double turn_rate_rad_s_ = 0.0;
  std::optional<Path> path_;
  double along_path_m_ = 0.0;
  std::optional<double> turn_to_rad_;  ///< only without a path
};

/// The greatest speed from which a body that brakes in steps stops within a distance. For turns:
/// rad for m.
double braking_speed(double distance_m, double acceleration_m_s2, double time_step_s);

}  // namespace nbvopt
