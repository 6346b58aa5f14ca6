// Where the free space in a slice ends in the unknown.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt {

/// The frontiers of one layer of voxels, in the box, row by row: centres (x, y in the map) of free
/// voxels with an unknown neighbour in x or y; of neighbours towards +x and +y it asks only where
/// it `looks_both_ways`. The grid must be whole.
std::vector<Eigen::Vector2d> slice_frontiers(const VoxelGrid& grid, const KeyBox& box,
                                             std::uint16_t layer, bool looks_both_ways);

/// Frontiers that lie near the first of them.
struct FrontierGroup {
  std::vector<Eigen::Vector2d> points_map_m;  ///< at least one
};

/// Each frontier joins the first group whose first one lies within the radius, or opens a new one.
std::vector<FrontierGroup> group_frontiers(std::span<const Eigen::Vector2d> points_map_m,
                                           double radius_m);

}  // namespace nbvopt
