// Rigid transforms and frames.
//
// T_a_b takes coordinates in frame b to coordinates in frame a: p_a = T_a_b * p_b.
// Frames: map (z up), base (the robot, z up), body (x forward, y left, z up, at the camera),
// sensor (the optical frame of ROS REP 103: z forward, x right, y down). Metres and radians.
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace nbvopt {

using Transform = Eigen::Isometry3d;

/// T_map_base of a base that stands at (x, y, z), turned by yaw about the map's z axis.
/// Throws InputError for a finite yaw beyond 1e4 rad.
Transform base_pose(double x_m, double y_m, double z_m, double yaw_rad);

/// The rotation that takes optical to body axes: body x = optical z, body y = -optical x,
/// body z = -optical y.
Eigen::Matrix3d rotation_body_sensor();

/// The transform with this position and quaternion (x, y, z, w; any length but zero).
/// Throws InputError when a number is not finite or the quaternion's length is zero.
Transform pose_from_quaternion(const std::array<double, 3>& position_m,
                               const std::array<double, 4>& orientation_xyzw);

/// The same angle in (-pi, pi].
double wrap_angle(double angle_rad);

}  // namespace nbvopt
