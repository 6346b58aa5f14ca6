// From where a group of frontiers may be looked at.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "sim/exploration/volume/frontier_slice.hpp"
#include "sim/exploration/volume/rules.hpp"

namespace nbvopt {

/// The poses of the base (x, y, yaw in the map) on rings 0.5 m apart around each group's first
/// frontier, which the camera faces there. The voxel at the camera's height is known, none within
/// 0.3 m in x and y and from 0.1 m below to 0.3 m above it is occupied, and frontiers and the
/// robot, which is at T_map_base, are as far as the rules say. The grid must be whole.
std::vector<Eigen::Vector3d> candidate_poses(const VoxelGrid& grid,
                                             std::span<const FrontierGroup> groups,
                                             const Transform& T_map_base,
                                             const Transform& T_base_sensor,
                                             const VolumeRules& rules);

}  // namespace nbvopt
