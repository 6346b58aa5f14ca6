// A robot's week with a planning server, in compressed time and with all that goes wrong.
#pragma once

#include <cstdint>
#include <string>

namespace nbvopt::bench {

/// Scans, plans and faults, drawn by a seed, for so many minutes: clients that come and go, that
/// cancel, that do not read their maps, that ask for too much; kills, ends, stops and full disks.
/// After each event the server's map is that of a model, what it called durable is there, no call
/// has timed out, and its memory is within what its limits allow. Returns Markdown tables; throws
/// std::runtime_error, naming seed and event, where any of this is not so.
std::string soak_server(double minutes, std::uint64_t seed);

}  // namespace nbvopt::bench
