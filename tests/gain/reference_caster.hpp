// A ray cast voxel by voxel in extended precision: what the fast casters are held against.
#pragma once

#include <Eigen/Core>

#include "nbvopt/gain/ray_caster.hpp"

namespace nbvopt::test {

/// How one ray ends.
struct ReferenceHit {
  HitKind kind = HitKind::none;
  Face face = Face::inside;
  VoxelKey voxel;
  double distance_m = 0.0;
  float uncertainty = kUnknownUncertainty;
  /// How near, in voxels, the ray comes to an edge of a voxel on its way, or its origin and the
  /// points at range_min and range_max to a face. Where that is rounding, the voxel beyond is
  /// right too.
  double clearance_voxels = 1.0;
};

/// The grid must be ready wherever the ray goes.
ReferenceHit reference_cast(const VoxelGrid& grid, const RayBundle& rays, std::size_t ray,
                            double occupied_uncertainty);

}  // namespace nbvopt::test
