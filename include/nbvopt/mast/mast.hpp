// The pan / tilt / telescopic mast: limits, velocities, reachable box, forward kinematics.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

/// The joints in the order of every 3-vector q = (pan, tilt, height).
enum class Joint { pan = 0, tilt = 1, height = 2 };
inline constexpr std::array<Joint, 3> kJoints{Joint::pan, Joint::tilt, Joint::height};
std::string to_string(Joint value);

/// Pan turns about base z or a line beside it, counter-clockwise from above; positive tilt looks
/// up; height is the optical centre's z above the base when the sensor offset is zero.
struct JointPosition {
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  double height_m = 0.0;

  Eigen::Vector3d vector() const { return {pan_rad, tilt_rad, height_m}; }
  static JointPosition from(const Eigen::Vector3d& q) { return {q[0], q[1], q[2]}; }
  bool operator==(const JointPosition&) const = default;
};

/// A closed box of joint positions, (pan, tilt, height).
struct JointBox {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();

  bool contains(const Eigen::Vector3d& q) const {
    return (q.array() >= min.array()).all() && (q.array() <= max.array()).all();
  }
};

/// The default is the paper's platform.
struct MastOptions {
  bool pan_continuous = true;  ///< turns without end; pan limits are then not used
  double pan_min_rad = -3.14159265358979323846;
  double pan_max_rad = 3.14159265358979323846;
  double pan_velocity_rad_s = 3.14159265358979323846;
  double tilt_min_rad = -0.79;
  double tilt_max_rad = 0.79;
  double tilt_velocity_rad_s = 0.5;
  double height_min_m = 0.18;
  double height_max_m = 0.63;
  double height_velocity_m_s = 0.15;
  double pan_axis_x_m = 0.0;  ///< where the pan axis stands on the base, forward of its origin
  double pan_axis_y_m = 0.0;  ///< the same to its left
  /// From the tilt joint to the optical centre, in body axes (x forward, y left, z up).
  Eigen::Vector3d sensor_offset_m = Eigen::Vector3d::Zero();

  bool operator==(const MastOptions&) const = default;

  /// Throws InputError that names the first bad field with its value.
  void validate() const;
};

/// Kinematics of the mast. Joint times are those of the slowest joint.
class Mast {
 public:
  /// Throws InputError as MastOptions::validate() does.
  explicit Mast(const MastOptions& options);

  const MastOptions& options() const { return options_; }

  /// Joint velocities (rad/s, rad/s, m/s).
  const Eigen::Vector3d& velocity() const { return velocity_; }

  /// T_base_sensor = T_base_mast * T_mast_sensor.
  Transform T_base_sensor(const JointPosition& q) const;

  /// The mast's foot, where the pan axis meets the base's x, y plane; a translation.
  Transform T_base_mast() const;

  /// T_mast_sensor = translation(0, 0, height) * Rz(pan) * Ry(-tilt) * (offset, O).
  Transform T_mast_sensor(const JointPosition& q) const;

  /// Algorithm 2's ranges: per joint [max(min, q - v t), min(max, q + v t)]; t = 0 means no
  /// limit. A continuous pan's box is at most one turn, centred on the current pan, unwrapped.
  /// q lies in it to the last bit. Throws UsageError when q is not within limits, or when t is
  /// negative or not finite.
  JointBox reachable_box(const JointPosition& q, double motion_time_s) const;

  /// The time that the slowest joint needs from one position to another, seconds.
  double move_time_s(const JointPosition& from, const JointPosition& to) const;

  /// Where the joints are on their way from one position to another, each at its velocity until it
  /// has arrived, this long after they set out.
  JointPosition on_the_way(const JointPosition& from, const JointPosition& to,
                           double elapsed_s) const;

  /// q moved into the limits. Joints beyond them by more than 0.01 rad or 5 mm are refused with
  /// an InputError that names joint, value and limits; smaller ones are clamped, each adding a
  /// line to `warnings`.
  JointPosition clamped(const JointPosition& q, std::vector<std::string>& warnings) const;

 private:
  MastOptions options_;
  Eigen::Vector3d velocity_;
};

}  // namespace nbvopt
