#include "nbvopt/mast/moving_mast.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {
namespace {

/// sin(x) / x; exact to rounding for every x but 0.
double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

/// The pose, seen from where it started, of a base that keeps its velocity for a time.
Transform driven(const BaseTwist& twist, double time_s) {
  const double turn_rad = twist.wz_rad_s * time_s;
  const Eigen::Vector3d path_m = Eigen::Vector3d(twist.vx_m_s, twist.vy_m_s, 0.0) * time_s;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  // The chord of the arc: turned by half the turn, and shorter than the path by sinc of it.
  Transform T_start_end = Transform::Identity();
  T_start_end.translation() =
      sinc(0.5 * turn_rad) * (Eigen::AngleAxisd(0.5 * turn_rad, z) * path_m);
  T_start_end.linear() = Eigen::AngleAxisd(turn_rad, z).toRotationMatrix();
  return T_start_end;
}

/// The velocity of a point of the base.
BaseTwist twist_beside(const BaseTwist& base, double x_m, double y_m) {
  return {base.vx_m_s - base.wz_rad_s * y_m, base.vy_m_s + base.wz_rad_s * x_m, base.wz_rad_s};
}

}  // namespace

MovingMast::MovingMast(const Mast& mast, const Transform& T_map_base, const BaseTwist& base_twist,
                       const JointPosition& joints)
    : mast_(mast),
      T_map_mast_(T_map_base * mast.T_base_mast()),
      mast_twist_(
          twist_beside(base_twist, mast.options().pan_axis_x_m, mast.options().pan_axis_y_m)),
      joints_(joints) {}

double MovingMast::longest_arrival_time_s(const JointBox& box) const {
  return std::max(arrival_time_s(JointPosition::from(box.min)),
                  arrival_time_s(JointPosition::from(box.max)));
}

Transform MovingMast::T_map_base(double time_s) const {
  return T_map_mast(time_s) * mast_.T_base_mast().inverse();
}

Transform MovingMast::T_map_mast(double time_s) const {
  if (mast_twist_.is_zero()) return T_map_mast_;
  return T_map_mast_ * driven(mast_twist_, time_s);
}

Transform MovingMast::T_map_sensor(const JointPosition& q) const {
  const Transform T_mast_sensor = mast_.T_mast_sensor(q);
  if (mast_twist_.is_zero()) return T_map_mast_ * T_mast_sensor;
  return T_map_mast(arrival_time_s(q)) * T_mast_sensor;
}

Eigen::Vector3d MovingMast::arrival_time_gradient(const JointPosition& q) const {
  const Eigen::Vector3d way = q.vector() - joints_.vector();
  Eigen::Index slowest = 0;
  (way.cwiseAbs().array() / mast_.velocity().array()).maxCoeff(&slowest);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  gradient[slowest] = std::copysign(1.0, way[slowest]) / mast_.velocity()[slowest];
  return gradient;
}

SensorMotion MovingMast::sensor_motion(const JointPosition& q) const {
  const Transform T_mast_sensor = mast_.T_mast_sensor(q);
  const Eigen::Matrix3d R_sensor_mast = T_mast_sensor.linear().transpose();
  const Eigen::Vector3d p_mast = T_mast_sensor.translation();
  const Eigen::Vector3d lever_mast = p_mast - Eigen::Vector3d(0.0, 0.0, q.height_m);
  const Eigen::Vector3d z_mast = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right_sensor = Eigen::Vector3d::UnitX();  // the axis that tilt turns about

  SensorMotion motion;
  motion.angular = {R_sensor_mast * z_mast, right_sensor, Eigen::Vector3d::Zero()};
  motion.linear = {R_sensor_mast * z_mast.cross(p_mast),
                   right_sensor.cross(R_sensor_mast * lever_mast), R_sensor_mast * z_mast};
  if (mast_twist_.is_zero()) return motion;

  const Eigen::Vector3d turn_mast = mast_twist_.wz_rad_s * z_mast;
  const Eigen::Vector3d velocity_mast =
      Eigen::Vector3d(mast_twist_.vx_m_s, mast_twist_.vy_m_s, 0.0) + turn_mast.cross(p_mast);
  const Eigen::Vector3d time_gradient = arrival_time_gradient(q);
  for (std::size_t i = 0; i < motion.angular.size(); ++i) {
    const double time_per_joint = time_gradient[static_cast<Eigen::Index>(i)];
    motion.angular[i] += time_per_joint * (R_sensor_mast * turn_mast);
    motion.linear[i] += time_per_joint * (R_sensor_mast * velocity_mast);
  }
  return motion;
}

}  // namespace nbvopt
