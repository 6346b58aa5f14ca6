#include "protocol/pose_messages.hpp"

#include <array>

#include "nbvopt/core/error.hpp"
#include "protocol/needed_field.hpp"

namespace nbvopt {
namespace {

/// Rotations as far as rounding of 32-bit numbers goes; a projection would change the last bit.
Eigen::Matrix3d rotation_from(const v1::Pose& pose, const std::string& field) {
  constexpr double kRounding = 1e-5;
  if (pose.rotation_size() != 9) {
    throw InputError(field + ".rotation has " + std::to_string(pose.rotation_size()) +
                     " numbers, give 9");
  }
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.rotation().data());
  const double deviation =
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(deviation < kRounding) || rotation.determinant() < 0.0) {
    throw InputError(field + ".rotation is not a rotation matrix");
  }
  return rotation;
}

}  // namespace

Transform from_message(const v1::Pose& pose, const std::string& field) {
  const std::array<double, 3> position_m{needed(pose.has_x_m(), pose.x_m(), field + ".x_m"),
                                         needed(pose.has_y_m(), pose.y_m(), field + ".y_m"),
                                         needed(pose.has_z_m(), pose.z_m(), field + ".z_m")};
  if (pose.rotation_size() > 0) {
    Transform T = Transform::Identity();
    T.translation() = Eigen::Vector3d(position_m[0], position_m[1], position_m[2]);
    T.linear() = rotation_from(pose, field);
    return T;
  }
  const std::array<double, 4> orientation_xyzw{needed(pose.has_qx(), pose.qx(), field + ".qx"),
                                               needed(pose.has_qy(), pose.qy(), field + ".qy"),
                                               needed(pose.has_qz(), pose.qz(), field + ".qz"),
                                               needed(pose.has_qw(), pose.qw(), field + ".qw")};
  try {
    return pose_from_quaternion(position_m, orientation_xyzw);
  } catch (const InputError& error) {
    throw InputError(field + ": " + error.what());
  }
}

Transform from_message(const v1::BasePose& base, const std::string& field) {
  switch (base.kind_case()) {
    case v1::BasePose::kPlanar: {
      const v1::PlanarPose& planar = base.planar();
      const std::string name = field + ".planar";
      const std::array<double, 4> numbers{
          needed(planar.has_x_m(), planar.x_m(), name + ".x_m"),
          needed(planar.has_y_m(), planar.y_m(), name + ".y_m"),
          needed(true, planar.z_m(), name + ".z_m"),
          needed(planar.has_yaw_rad(), planar.yaw_rad(), name + ".yaw_rad")};
      return base_pose(numbers[0], numbers[1], numbers[2], numbers[3]);
    }
    case v1::BasePose::kPose:
      return from_message(base.pose(), field + ".pose");
    case v1::BasePose::KIND_NOT_SET:
      break;
  }
  throw InputError(field + " is not set: give planar or pose");
}

JointPosition from_message(const v1::JointPosition& joints, const std::string& field) {
  return {
      .pan_rad = needed(joints.has_pan_rad(), joints.pan_rad(), field + ".pan_rad"),
      .tilt_rad = needed(joints.has_tilt_rad(), joints.tilt_rad(), field + ".tilt_rad"),
      .height_m = needed(joints.has_height_m(), joints.height_m(), field + ".height_m"),
  };
}

BaseTwist from_message(const v1::BaseTwist& twist, const std::string& field) {
  return {.vx_m_s = needed(twist.has_vx_m_s(), twist.vx_m_s(), field + ".vx_m_s"),
          .vy_m_s = needed(twist.has_vy_m_s(), twist.vy_m_s(), field + ".vy_m_s"),
          .wz_rad_s = needed(twist.has_wz_rad_s(), twist.wz_rad_s(), field + ".wz_rad_s")};
}

Transform from_message(const v1::View& view, const Mast& mast, const std::string& field) {
  switch (view.kind_case()) {
    case v1::View::kSensor:
      return from_message(view.sensor(), field + ".sensor");
    case v1::View::kMounted: {
      const std::string name = field + ".mounted";
      return from_message(view.mounted().base(), name + ".base") *
             mast.T_base_sensor(from_message(view.mounted().joints(), name + ".joints"));
    }
    case v1::View::KIND_NOT_SET:
      break;
  }
  throw InputError(field + " is not set: give sensor or mounted");
}

v1::Pose to_message(const Transform& T) {
  v1::Pose pose;
  const Eigen::Vector3d p = T.translation();
  const Eigen::Quaterniond q(T.linear());
  pose.set_x_m(p.x());
  pose.set_y_m(p.y());
  pose.set_z_m(p.z());
  pose.set_qx(q.x());
  pose.set_qy(q.y());
  pose.set_qz(q.z());
  pose.set_qw(q.w());
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.add_rotation(T.linear()(row, column));
  }
  return pose;
}

v1::JointPosition to_message(const JointPosition& joints) {
  v1::JointPosition message;
  message.set_pan_rad(joints.pan_rad);
  message.set_tilt_rad(joints.tilt_rad);
  message.set_height_m(joints.height_m);
  return message;
}

}  // namespace nbvopt
