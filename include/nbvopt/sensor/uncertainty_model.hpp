// How uncertain a point is that the camera sees: Eq. 1 to 8.
#pragma once

#include <Eigen/Core>

#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// u_n of what nobody has seen: the mean of what cameras met on drives through three worlds was
/// 0.39 to 0.40 (docs/decisions.md).
inline constexpr double kUnseenNormalUncertainty = 0.4;

/// u of a point in the sensor frame, in [0, 1).
class UncertaintyModel {
 public:
  explicit UncertaintyModel(const SensorOptions& options);

  /// Eq. 2 of a point at this Euclidean distance; in [0, 1).
  double distance_uncertainty(double distance_m) const;

  /// Eq. 2 of a point whose distance differs from the focal distance by this much; in [0, 1).
  static double focal_uncertainty(double d_focal_m);

  /// Eq. 7 of a point in this direction, which need not have unit length; in [0, 1].
  double angle_uncertainty(const Eigen::Vector3d& direction_sensor) const;

  /// u_n = 1 - |n . r| of a surface with the unit normal n, seen along the unit direction r, both
  /// in one frame; kUnseenNormalUncertainty where n is zero: not known.
  static double normal_uncertainty(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction);

  /// Eq. 8, or Eq. 2 or 7 alone, as the mode says, times 1 - normal_weight(), and the share
  /// normal_weight() of u_n. It is linear in all of them:
  /// u = distance_weight() * u_d + angle_weight() * u_alpha + normal_weight() * u_n.
  /// This is the part without normals.
  double uncertainty(const Eigen::Vector3d& p_sensor_m) const;
  /// With the surface's unit normal in the sensor frame.
  double uncertainty(const Eigen::Vector3d& p_sensor_m, const Eigen::Vector3d& normal) const {
    return uncertainty(p_sensor_m) +
           normal_weight_ * normal_uncertainty(normal, p_sensor_m.normalized());
  }

  double distance_weight() const { return distance_weight_; }
  double angle_weight() const { return angle_weight_; }
  double normal_weight() const { return normal_weight_; }
  /// Short of the clamp at the edge of the field of view u is linear in |alpha_h| and |alpha_v|
  /// (Eq. 3 to 8): what a radian of each adds.
  double horizontal_weight_per_rad() const {
    return angle_weight_ / (2.0 * half_fov_horizontal_rad_);
  }
  double vertical_weight_per_rad() const { return angle_weight_ / (2.0 * half_fov_vertical_rad_); }
  double focal_distance_m() const { return focal_distance_m_; }

 private:
  double focal_distance_m_;
  double half_fov_horizontal_rad_;
  double half_fov_vertical_rad_;
  double distance_weight_ = 0.0;
  double angle_weight_ = 0.0;
  double normal_weight_;
};

}  // namespace nbvopt
