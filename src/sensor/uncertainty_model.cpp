#include "nbvopt/sensor/uncertainty_model.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {
namespace {

double or_else(double value, double fallback) { return value > 0.0 ? value : fallback; }

}  // namespace

UncertaintyModel::UncertaintyModel(const SensorOptions& options)
    : focal_distance_m_(options.focal_distance_m),
      half_fov_horizontal_rad_(
          or_else(options.uncertainty_half_fov_horizontal_rad, options.half_fov_horizontal_rad)),
      half_fov_vertical_rad_(
          or_else(options.uncertainty_half_fov_vertical_rad, options.half_fov_vertical_rad)),
      normal_weight_(options.normal_weight) {
  switch (options.uncertainty_mode) {
    case UncertaintyMode::distance:
      distance_weight_ = 1.0;
      angle_weight_ = 0.0;
      break;
    case UncertaintyMode::angle:
      distance_weight_ = 0.0;
      angle_weight_ = 1.0;
      break;
    case UncertaintyMode::both:
      distance_weight_ = 0.5;
      angle_weight_ = 0.5;
      break;
  }
  distance_weight_ *= 1.0 - normal_weight_;
  angle_weight_ *= 1.0 - normal_weight_;
}

double UncertaintyModel::distance_uncertainty(double distance_m) const {
  return focal_uncertainty(std::abs(distance_m - focal_distance_m_));  // Equation (1)
}

double UncertaintyModel::focal_uncertainty(double d_focal_m) {
  return 1.0 - 2.0 / (1.0 + std::exp(d_focal_m));  // Equation (2)
}

double UncertaintyModel::angle_uncertainty(const Eigen::Vector3d& direction_sensor) const {
  const double alpha_h = std::atan2(direction_sensor.x(), direction_sensor.z());  // Equation (3)
  const double alpha_v = std::atan2(direction_sensor.y(), direction_sensor.z());  // Equation (4)
  // Equations (5), (6): by half the field of view, so that they reach 1 at its edge.
  const double normalised_h = std::min(1.0, std::abs(alpha_h) / half_fov_horizontal_rad_);
  const double normalised_v = std::min(1.0, std::abs(alpha_v) / half_fov_vertical_rad_);
  return (normalised_h + normalised_v) / 2.0;  // Equation (7)
}

double UncertaintyModel::normal_uncertainty(const Eigen::Vector3d& normal,
                                            const Eigen::Vector3d& direction) {
  return normal.isZero() ? kUnseenNormalUncertainty : 1.0 - std::abs(normal.dot(direction));
}

double UncertaintyModel::uncertainty(const Eigen::Vector3d& p_sensor_m) const {
  return distance_weight_ * distance_uncertainty(p_sensor_m.norm()) +
         angle_weight_ * angle_uncertainty(p_sensor_m);  // Equation (8)
}

}  // namespace nbvopt
