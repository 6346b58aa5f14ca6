// Poses in the plane, where bases drive.
#pragma once

#include <cmath>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

/// T_a_b in the plane: where frame b lies in frame a.
struct PlanarPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;  ///< in (-pi, pi] after every operation below

  bool operator==(const PlanarPose&) const = default;
};

/// T_a_c of T_a_b and T_b_c.
inline PlanarPose operator*(const PlanarPose& T_a_b, const PlanarPose& T_b_c) {
  const double c = std::cos(T_a_b.yaw_rad);
  const double s = std::sin(T_a_b.yaw_rad);
  return {T_a_b.x_m + c * T_b_c.x_m - s * T_b_c.y_m, T_a_b.y_m + s * T_b_c.x_m + c * T_b_c.y_m,
          wrap_angle(T_a_b.yaw_rad + T_b_c.yaw_rad)};
}

/// T_b_a of T_a_b.
inline PlanarPose inverse(const PlanarPose& T_a_b) {
  const double c = std::cos(T_a_b.yaw_rad);
  const double s = std::sin(T_a_b.yaw_rad);
  return {-c * T_a_b.x_m - s * T_a_b.y_m, s * T_a_b.x_m - c * T_a_b.y_m, -T_a_b.yaw_rad};
}

/// What of a pose lies in the plane.
inline PlanarPose planar_pose(const Transform& T_a_b) {
  return {T_a_b.translation().x(), T_a_b.translation().y(),
          std::atan2(T_a_b.linear()(1, 0), T_a_b.linear()(0, 0))};
}

}  // namespace nbvopt
