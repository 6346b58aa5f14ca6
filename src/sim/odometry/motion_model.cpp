#include "sim/odometry/motion_model.hpp"

#include <cmath>

#include "core/normal.hpp"

namespace nbvopt {
namespace {

constexpr double kTranslationPerTranslation = 0.1;            ///< srr, m/m
constexpr double kRotationPerTranslation = 0.2;               ///< srt, rad/m
constexpr double kTranslationPerRotation = 0.1;               ///< str, m/rad
constexpr double kRotationPerRotation = 0.2;                  ///< stt, rad/rad
constexpr double kAcross = 0.3 * kTranslationPerTranslation;  ///< of the other axis, m/m

}  // namespace

Eigen::Vector3d MotionModel::draw_normals(std::mt19937_64& generator) {
  Eigen::Vector3d normals;
  for (double& normal : normals) normal = standard_normal(generator);
  return normals;
}

Eigen::Vector3d MotionModel::deviations(const PlanarPose& motion) const {
  const double dx_m = std::abs(motion.x_m);
  const double dy_m = std::abs(motion.y_m);
  const double turn_rad = std::abs(motion.yaw_rad);
  const double by_turn_m = kTranslationPerRotation * turn_rad;
  return scale_ * Eigen::Vector3d(kTranslationPerTranslation * dx_m + by_turn_m + kAcross * dy_m,
                                  kTranslationPerTranslation * dy_m + by_turn_m + kAcross * dx_m,
                                  kRotationPerRotation * turn_rad +
                                      kRotationPerTranslation * std::hypot(motion.x_m, motion.y_m));
}

PlanarPose MotionModel::erring(const PlanarPose& motion, const Eigen::Vector3d& normals) const {
  const Eigen::Vector3d error = deviations(motion).cwiseProduct(normals);
  return {motion.x_m + error.x(), motion.y_m + error.y(), wrap_angle(motion.yaw_rad + error.z())};
}

}  // namespace nbvopt
