// What a depth camera would see in a known world.
#pragma once

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// The depth image of sensor.horizontal_pixels x vertical_pixels from T_map_sensor, without noise:
/// a return a pixel that meets an occupied voxel within range, a no-return a pixel that meets
/// none or leaves the known world (a window); nothing for what stands nearer than range_min.
/// The same on every machine: it is cast in scalar code.
Scan simulate_scan(const VoxelGrid& world, const SensorOptions& sensor,
                   const Transform& T_map_sensor);

}  // namespace nbvopt
