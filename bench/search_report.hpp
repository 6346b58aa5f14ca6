// The measured searches as a table for people and as lines for programs.
#pragma once

#include <string>
#include <vector>

#include "bench/search_measurements.hpp"

namespace nbvopt::bench {

/// A Markdown table, a row a map and search that ran: times are the means over queries, and the
/// slowest query, of each query's shortest time.
std::string to_table(const std::vector<SearchMeasurements>& maps);

/// One JSON object a line, map, search and query.
std::string to_json_lines(const std::vector<SearchMeasurements>& maps);

}  // namespace nbvopt::bench
