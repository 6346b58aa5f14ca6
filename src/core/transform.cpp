#include "nbvopt/core/transform.hpp"

#include <cmath>
#include <numbers>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

Transform base_pose(double x_m, double y_m, double z_m, double yaw_rad) {
  constexpr double kFarthestTurned_rad = 1e4;  // beyond, a slip of the unit
  if (std::isfinite(yaw_rad) && std::abs(yaw_rad) > kFarthestTurned_rad) {
    throw InputError("base: yaw is " + format_number(yaw_rad) + " rad, it must be within " +
                     format_number(kFarthestTurned_rad) + " rad of 0");
  }
  Transform T_map_base = Transform::Identity();
  T_map_base.translate(Eigen::Vector3d(x_m, y_m, z_m));
  T_map_base.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return T_map_base;
}

Eigen::Matrix3d rotation_body_sensor() {
  Eigen::Matrix3d R_body_sensor;
  R_body_sensor << 0, 0, 1,  //
      -1, 0, 0,              //
      0, -1, 0;
  return R_body_sensor;
}

Transform pose_from_quaternion(const std::array<double, 3>& position_m,
                               const std::array<double, 4>& orientation_xyzw) {
  const Eigen::Vector3d position(position_m[0], position_m[1], position_m[2]);
  const Eigen::Quaterniond q(orientation_xyzw[3], orientation_xyzw[0], orientation_xyzw[1],
                             orientation_xyzw[2]);
  if (!position.allFinite()) throw InputError("position: every number must be finite");
  if (!q.coeffs().allFinite()) throw InputError("orientation_xyzw: every number must be finite");
  if (!std::isfinite(q.norm())) {
    throw InputError("orientation_xyzw: the quaternion is too long, give one of length 1");
  }
  if (q.norm() < 1e-9) {
    throw InputError("orientation_xyzw: the quaternion has length zero, give a rotation");
  }
  Transform T = Transform::Identity();
  T.translate(position);
  T.rotate(q.normalized());
  return T;
}

double wrap_angle(double angle_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double wrapped = std::remainder(angle_rad, kTurn);
  return wrapped <= -std::numbers::pi ? wrapped + kTurn : wrapped;
}

}  // namespace nbvopt
