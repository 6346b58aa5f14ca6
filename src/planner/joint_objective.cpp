#include "planner/joint_objective.hpp"

#include <numbers>

namespace nbvopt {

double JointObjective::tie_cost(const Point& x) const {
  return mast_.arrival_time_s(JointPosition::from(x));
}

double JointObjective::period(Eigen::Index joint) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kRounding = 1e-9;
  const bool is_pan = joint == static_cast<Eigen::Index>(Joint::pan);
  if (!is_pan || !mast_.mast().options().pan_continuous) return 0.0;
  return box_.upper[joint] - box_.lower[joint] > kTurn - kRounding ? kTurn : 0.0;
}

double JointObjective::length_scale(Eigen::Index joint) const {
  const double ray_spacing_rad = 2.0 * sensor_.half_fov_horizontal_rad / sensor_.horizontal_rays;
  const bool is_height = joint == static_cast<Eigen::Index>(Joint::height);
  return is_height ? ray_spacing_rad * sensor_.focal_distance_m : ray_spacing_rad;
}

}  // namespace nbvopt
