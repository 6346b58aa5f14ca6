// The evaluations of a search as a file.
#pragma once

#include <string>
#include <vector>

#include "nbvopt/planner/planner.hpp"

namespace nbvopt {

/// One JSON object a line and evaluation, in order: its number, kind, joints and gain, the best
/// gain so far (null before the first exact one) and the time since the search began.
std::string to_json_lines(const std::vector<TracePoint>& trace);

}  // namespace nbvopt
