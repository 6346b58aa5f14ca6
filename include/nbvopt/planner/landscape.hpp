// The gain over pan and tilt, and the way that a search took through it.
#pragma once

#include <cstddef>
#include <vector>

#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// The evaluator's gain over the reachable pans and tilts at one height, on a regular grid that
/// holds the box's edges; a joint that cannot move has one value.
struct Landscape {
  double height_m = 0.0;
  std::vector<double> pan_rad;   ///< ascending
  std::vector<double> tilt_rad;  ///< ascending
  std::vector<double> gain;      ///< row by row, a row a tilt

  double at(std::size_t pan, std::size_t tilt) const { return gain[tilt * pan_rad.size() + pan]; }
  /// Interpolated linearly; at the nearest edge outside.
  double interpolated(double pan_rad_at, double tilt_rad_at) const;
};

/// The successive best views of a search: what was better than all before.
std::vector<TracePoint> improvements(const std::vector<TracePoint>& trace);

/// The pans of the paper's grid (Algorithm 2); none where they lie too close to be told apart.
std::vector<double> candidate_pans(const JointBox& box, double step_rad);

}  // namespace nbvopt
