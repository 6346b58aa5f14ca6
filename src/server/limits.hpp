// What one client may ask of the server.
#pragma once

#include <cstdint>

namespace nbvopt {

/// Each is an option of `nbvopt serve`, which messages name.
struct ServerLimits {
  std::int64_t max_message_mib = 16;
  std::int64_t max_scan_points = 2'000'000;
  std::int64_t max_views = 10'000;   ///< a call of Evaluate
  double max_map_extent_m = 500.0;   ///< the longest side of the map's box
  double min_resolution_m = 0.01;    ///< the smallest voxels of a map
  std::int64_t max_map_mib = 2048;   ///< of the bricks that plans read, about 45 kB each
  double max_compute_ms = 10'000.0;  ///< of a plan or a call of Evaluate
  std::int64_t max_waiting = 64;     ///< calls that wait for a thread, of each kind of work
  std::int64_t max_streams = 256;    ///< streams that are open
};

}  // namespace nbvopt
