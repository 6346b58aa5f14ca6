// Where cameras of tests stand.
#pragma once

#include "nbvopt/core/transform.hpp"

namespace nbvopt::test {

/// A camera that looks along map x where yaw and pitch are 0; positive yaw is to the left,
/// positive pitch up.
inline Transform camera_at(const Eigen::Vector3d& position_m, double yaw_rad = 0.0,
                           double pitch_rad = 0.0) {
  Transform T_map_sensor = Transform::Identity();
  T_map_sensor.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitY()) *
                          rotation_body_sensor();
  T_map_sensor.translation() = position_m;
  return T_map_sensor;
}

}  // namespace nbvopt::test
