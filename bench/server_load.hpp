// A server under the load of a robot that drives: scans come in while plans are asked for.
#pragma once

#include <string>

namespace nbvopt::bench {

/// 10 scans of 480 x 360 points and 20 plans a second for so many minutes, on a growing map of
/// 0.1 m; each plan has until the next one is asked for. Returns Markdown tables.
std::string measure_server_load(double minutes);

}  // namespace nbvopt::bench
