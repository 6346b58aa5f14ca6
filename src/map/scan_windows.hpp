// Cuts a scan into windows, which bounds the memory that a long one takes.
#pragma once

#include <array>
#include <vector>

#include "map/scan_rays.hpp"

namespace nbvopt {

/// The part of the lattice that one window covers, with the rays that may pierce it and the hits
/// in it.
struct WindowWork {
  VoxelKey least;
  std::array<int, 3> tiles{};
  ScanRays rays;
};

/// The windows in an order that depends on nothing but their places. A camera's scan at the usual
/// resolutions is one window.
std::vector<WindowWork> scan_windows(ScanRays rays);

}  // namespace nbvopt
