// The part of u that tells how slantwise a surface is seen, taken off what a hit brings.
#pragma once

#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt::detail {

/// The unit normal of an occupied voxel, towards its free neighbours of 26, each with the weight of
/// its nearness; zero where these cancel out or where there is none.
Eigen::Vector3d surface_normal(const VoxelGrid& grid, VoxelKey voxel);

/// u_old of what is unknown, without the part of normals that nobody has seen.
double unknown_without_normal_part(double weight);

/// Takes weight * u_n off the u_old of every hit, so that Eq. 12 with the rest of u_new is what it
/// is with all of it: u_n by the voxel's normal, or by the face that the ray enters where the voxel
/// has none; in the unknown kUnseenNormalUncertainty. Makes the hits' neighbours ready.
void take_normal_part(const VoxelGrid& grid, double weight, RayHits& hits);

}  // namespace nbvopt::detail
