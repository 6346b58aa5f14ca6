// Which voxels the expected gain of a view comes from.
#pragma once

#include <functional>
#include <memory>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt::detail {

/// Takes a voxel, which may come again with another ray, and what it is expected to bring that ray.
using AddExpectedPart = std::function<void(VoxelKey voxel, VoxelState state, double gain)>;

/// Calls add() ray after ray. Counted per ray the gain is the sum of all (Eq. 13), counted per
/// voxel that of the greatest of each voxel. Throws as cast_rays() does.
void add_expected_parts(const std::shared_ptr<const VoxelGrid>& grid, const DepthCamera& camera,
                        const HazardTable& hazards, const Transform& T_map_sensor,
                        const AddExpectedPart& add);

}  // namespace nbvopt::detail
