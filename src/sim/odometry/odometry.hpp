// What the wheels tell of a drive.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/sim/trajectory.hpp"
#include "sim/odometry/motion_model.hpp"

namespace nbvopt {

/// A piece of a drive, from one scan that is processed to the next: a metre, half a radian or two
/// seconds later, whichever comes first.
struct DriveStep {
  double begin_s;
  PlanarPose T_world_base;  ///< at its begin, true
  PlanarPose T_odom_base;   ///< at its begin, by the wheels
  Eigen::Vector3d normals;  ///< its error, standard normal: it grows with the motion in the step
};

/// Integrates the motions of a drive with their errors. The frame odom is such
/// that the wheels are right at the start.
class Odometry {
 public:
  /// The trajectory must outlive the odometry.
  Odometry(const Trajectory& trajectory, const MotionModel& model, std::uint64_t seed);

  /// At least one; the first begins at 0.
  std::span<const DriveStep> steps() const { return steps_; }

  PlanarPose T_odom_base(double time_s) const;

 private:
  const Trajectory& trajectory_;
  MotionModel model_;
  std::vector<DriveStep> steps_;
};

}  // namespace nbvopt
