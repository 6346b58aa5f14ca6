// The gain over pan and tilt, and the way that a search took through it.
#pragma once

#include <vector>

#include "core/json.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/planner.hpp"

namespace nbvopt {

/// The evaluator's gain over the reachable pans and tilts at one height, on a regular grid that
/// holds the box's edges; a joint that cannot move has one value.
struct GainLandscape {
  double height_m = 0.0;
  std::vector<double> pan_rad;   ///< ascending
  std::vector<double> tilt_rad;  ///< ascending
  std::vector<double> gain;      ///< row by row, a row a tilt

  double at(std::size_t pan, std::size_t tilt) const { return gain[tilt * pan_rad.size() + pan]; }
  /// Interpolated linearly; at the nearest edge outside.
  double interpolated(double pan_rad_at, double tilt_rad_at) const;
};

/// The landscape at the answer's height: a view every 0.05 rad, on all cores, or as dense as 20,000
/// views allow.
GainLandscape sample_landscape(const ViewEvaluator& evaluator, const Mast& mast,
                               const PlanRequest& request, const PlanResult& result);

/// The successive best views of a search: what was better than all before.
std::vector<TracePoint> improvements(const std::vector<TracePoint>& trace);

/// The landscape with the start, the answer, the pans of the paper's grid and the search's way
/// through it; `result` has its trace.
Json to_json(const GainLandscape& landscape, const PlanRequest& request, const PlanResult& result,
             const std::vector<double>& candidate_pans_rad);

}  // namespace nbvopt
