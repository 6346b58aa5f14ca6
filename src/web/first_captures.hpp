// When an episode saw what its map holds.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// Of each occupied voxel of the map, packed(), that a camera sees from any of these poses: the
/// number of the first such pose. Told from the map alone, as it was in the end: a recording holds
/// poses, not scans. Rays lie at most half a voxel apart at the camera's range, or as its
/// pixels do. Throws InputError where a pose is not finite or off the lattice.
std::unordered_map<std::uint64_t, std::uint16_t> first_captures(
    const VoxelGrid& grid, const SensorOptions& sensor,
    std::span<const Transform> poses_T_map_sensor);

}  // namespace nbvopt
