// The default strategy against grids over all joints, at equal cost.
#pragma once

#include <string>
#include <vector>

#include "bench/search_measurements.hpp"

namespace nbvopt::bench {

/// A Markdown table, a row a map and grid: what auto finds when it is stopped after as many
/// evaluations (exact and of surrogates together) as the grid makes, query by query, and when it is
/// stopped after as much time, to one evaluation (the median gain of five runs). Grids that were
/// not measured are left out.
std::string compare_with_grids(const std::vector<SearchMeasurements>& maps);

}  // namespace nbvopt::bench
