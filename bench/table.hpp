// The table of what was measured, with ratios within the same run.
#pragma once

#include <span>
#include <string>

#include "bench/measurement.hpp"

namespace nbvopt::bench {

/// A Markdown table of the measurements that ran: times are the means over items, and the longest
/// item, of each item's shortest time.
std::string to_table(std::span<const Measurement> measurements);

}  // namespace nbvopt::bench
