// Cuts a scan into windows, which bounds the memory that a long one takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "map/scan_rays.hpp"

namespace nbvopt {

/// The rays that may pierce one window and the hits in it, as indices of ScanRays.
struct WindowWork {
  VoxelKey least;
  std::array<int, 3> tiles{};
  std::vector<std::uint32_t> rays;
  std::vector<std::uint32_t> hits;
};

/// The windows in an order that depends on nothing but their places. A camera's scan at the usual
/// resolutions is one window.
std::vector<WindowWork> scan_windows(const ScanRays& rays);

}  // namespace nbvopt
