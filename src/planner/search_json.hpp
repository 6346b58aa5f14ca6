// How a search went, as files.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "nbvopt/planner/landscape.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

/// One JSON object a line and evaluation, in order: its number, kind, joints and gain, the best
/// gain so far (null before the first exact one) and the time since the search began.
std::string to_json_lines(const std::vector<TracePoint>& trace);

/// The landscape with the start, the answer, the pans of the paper's grid and the search's way
/// through it; `result` has its trace.
Json to_json(const Landscape& landscape, const PlanResult& result,
             const std::vector<double>& candidate_pans_rad);

}  // namespace nbvopt
