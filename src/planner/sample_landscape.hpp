// The landscape around an answer.
#pragma once

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/landscape.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// The landscape at the answer's height: a view every 0.05 rad, or as dense as 20,000 views allow.
/// `threads` and `stop` as in evaluate_views(): views that were left out gain NaN.
Landscape sample_landscape(const ViewEvaluator& evaluator, const Mast& mast,
                           const PlanResult& result, int threads = 0, const StopRule& stop = {});

}  // namespace nbvopt
