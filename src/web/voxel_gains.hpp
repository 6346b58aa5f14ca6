// Which voxels a view's gain comes from.
#pragma once

#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

struct VoxelGain {
  VoxelKey key;
  HitKind kind = HitKind::unknown;  ///< unknown or occupied
  double gain = 0.0;                ///< more than 0
};

/// The voxels that bring the view from T_map_sensor its positive gain (Eq. 12), each once; their
/// gains add up to the view's (Eq. 13), as the sensor counts. Throws InputError when the pose is
/// not finite or lies off the lattice.
std::vector<VoxelGain> voxel_gains(const VoxelGrid& grid, const SensorOptions& sensor,
                                   const Transform& T_map_sensor);

}  // namespace nbvopt
