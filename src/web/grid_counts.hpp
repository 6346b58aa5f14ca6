// What a grid holds.
#pragma once

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt {

/// Voxels and information of a whole grid; it has no leaves and nodes.
MapCounts grid_counts(const VoxelGrid& grid);

}  // namespace nbvopt
