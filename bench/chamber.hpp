// A world that chance made: a chamber of free space amid random voxels, the unknown right beside
// the camera.
#pragma once

#include <cstdint>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt::bench {

/// The map of the chamber of this number, the same on every machine: voxels of 0.5, 0.2, 0.1 or
/// 0.05 m, a few centimetres to a metre of free space.
UncertaintyMap make_chamber(std::uint64_t number);

}  // namespace nbvopt::bench
