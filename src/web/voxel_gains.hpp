// Which voxels a view's gain comes from.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

struct VoxelGain {
  VoxelKey key;
  VoxelState state = VoxelState::unknown;
  double gain = 0.0;  ///< more than 0
};

struct VoxelGains {
  std::vector<VoxelGain> voxels;  ///< each once
  std::string why_none;           ///< where voxels have no part in such a gain; else empty
};

/// The voxels that bring the view from T_map_sensor its gain, judged by "exact": their gains add up
/// to the view's, as the sensor counts. There are none where a gain of the sensor's choice is no
/// sum over voxels. Throws InputError when the pose is not finite or lies off the lattice.
VoxelGains voxel_gains(const std::shared_ptr<const VoxelGrid>& grid, const SensorOptions& sensor,
                       const HazardTable& hazards, const Transform& T_map_sensor);

}  // namespace nbvopt
