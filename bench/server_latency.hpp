// What a call costs over the search itself: one client on the loopback address.
#pragma once

#include <string>

namespace nbvopt::bench {

/// Measures on the known map, or the one that ships, and returns a Markdown table.
std::string measure_server_latency(int calls);

}  // namespace nbvopt::bench
