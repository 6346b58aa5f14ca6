// How wheels err.
#pragma once

#include <Eigen/Core>
#include <random>

#include "sim/odometry/planar_pose.hpp"

namespace nbvopt {

/// GMapping's model of odometry (openslam_gmapping, MotionModel::drawFromMotion) with the
/// coefficients that slam_gmapping sets by default, for one step from one processed scan to the
/// next.
class MotionModel {
 public:
  /// Three standard normal numbers, as erring() takes them.
  static Eigen::Vector3d draw_normals(std::mt19937_64& generator);

  /// `scale` multiplies all deviations; 0: the wheels do not err.
  explicit MotionModel(double scale) : scale_(scale) {}

  /// The standard deviations of the x (m), y (m) and yaw (rad) of a motion in the frame of the base
  /// before it.
  Eigen::Vector3d deviations(const PlanarPose& motion) const;

  /// The motion with its error: standard normal numbers times the deviations.
  PlanarPose erring(const PlanarPose& motion, const Eigen::Vector3d& normals) const;

 private:
  double scale_;
};

}  // namespace nbvopt
