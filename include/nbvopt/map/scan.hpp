// One scan of the camera, and its insertion into a map.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// What a driver gives for one frame, in the sensor (optical) frame.
struct Scan {
  std::vector<Eigen::Vector3f> points_m;             ///< returns; not finite ones are ignored
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< one a point, or empty
  std::vector<Eigen::Vector3f> no_returns;           ///< directions in which nothing is in range
};

/// What an insertion did.
struct InsertResult {
  std::vector<VoxelChange> changes;        ///< every voxel whose state or u changed, once
  std::uint64_t points_used = 0;           ///< returns with D_min < d < D_max
  std::uint64_t rays_cleared = 0;          ///< no-returns, and returns at or beyond D_max, cleared
  std::uint64_t points_ignored = 0;        ///< nearer than D_min, not finite, or off the lattice
  double information_gained = 0.0;         ///< what the map's Eq. 11 grew by
  std::int64_t certain_voxels_gained = 0;  ///< what its occupied voxels with u < 1 grew by
};

/// Inserts a scan taken from T_map_sensor: the voxels that a ray passes become freer, the one
/// that holds the point becomes more occupied and keeps the minimum u of all its observations,
/// the first included (Eq. 9). Occupied wins over free within one scan. A return at or beyond
/// D_max says the same as no return: its ray is clear up to D_max, the last voxel included
/// (unless `no_return` is ignore). Throws InputError when the pose is not finite or lies off the
/// lattice or the sensor's options are bad, UsageError when colours and points differ in number;
/// the map is then untouched.
InsertResult insert_scan(UncertaintyMap& map, const Scan& scan, const Transform& T_map_sensor,
                         const SensorOptions& sensor);

}  // namespace nbvopt
