// Where pan goes all the way round.
#pragma once

#include <numbers>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// Objective::period() of a joint: one turn of a continuous pan whose box holds all of it, else 0.
inline double joint_period(const Mast& mast, const Box& box, Eigen::Index joint) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kRounding = 1e-9;
  const bool is_pan = joint == static_cast<Eigen::Index>(Joint::pan);
  if (!is_pan || !mast.options().pan_continuous) return 0.0;
  return box.upper[joint] - box.lower[joint] > kTurn - kRounding ? kTurn : 0.0;
}

}  // namespace nbvopt
