// A mast on a base that keeps its velocity while the joints move: the only place that turns a
// base pose and q into a pose of the camera.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/mast/mast.hpp"

namespace nbvopt {

/// The base's velocity in its own frame: it drives an arc in its x, y plane.
struct BaseTwist {
  double vx_m_s = 0.0;
  double vy_m_s = 0.0;
  double wz_rad_s = 0.0;

  /// Of the base's origin.
  double speed_m_s() const { return std::hypot(vx_m_s, vy_m_s); }
  bool is_zero() const { return vx_m_s == 0.0 && vy_m_s == 0.0 && wz_rad_s == 0.0; }
  bool operator==(const BaseTwist&) const = default;
};

/// How the sensor moves with each joint, in the sensor frame.
struct SensorMotion {
  std::array<Eigen::Vector3d, 3> angular{};  ///< rad per rad or m of the joint
  std::array<Eigen::Vector3d, 3> linear{};   ///< m per rad or m of the joint
};

/// Where the camera will be once the joints have arrived. At rest, the base stays where it is.
/// What looks around (panoramas, bounds) knows the mast's foot alone, which the base carries along;
/// its frame has the base's axes.
class MovingMast {
 public:
  /// `joints` is where the mast is now, when the base is at T_map_base.
  MovingMast(const Mast& mast, const Transform& T_map_base, const BaseTwist& base_twist,
             const JointPosition& joints);

  const Mast& mast() const { return mast_; }
  const JointPosition& joints() const { return joints_; }
  /// The velocity of the mast's foot, in its own frame: the base's, and what turning adds.
  const BaseTwist& mast_twist() const { return mast_twist_; }

  /// When the slowest joint arrives at q, seconds from now.
  double arrival_time_s(const JointPosition& q) const { return mast_.move_time_s(joints_, q); }

  /// When the slowest joint has arrived at any q in the box, which holds joints().
  double longest_arrival_time_s(const JointBox& box) const;

  /// The derivative of arrival_time_s() by each joint, seconds per rad or m: that of the slowest
  /// joint alone. Where two joints arrive together, or none moves, the time has a kink: the
  /// derivative is of one side.
  Eigen::Vector3d arrival_time_gradient(const JointPosition& q) const;

  /// The base predicted for a time from now.
  Transform T_map_base(double time_s) const;

  /// The mast's foot, predicted so.
  Transform T_map_mast(double time_s) const;

  /// The optical frame once the joints have arrived at q.
  Transform T_map_sensor(const JointPosition& q) const;

  /// The derivative of T_map_sensor. Where two joints arrive together, or a joint does not move,
  /// the arrival time has a kink: it is then that of one side.
  SensorMotion sensor_motion(const JointPosition& q) const;

 private:
  Mast mast_;
  Transform T_map_mast_;
  BaseTwist mast_twist_;
  JointPosition joints_;
};

}  // namespace nbvopt
