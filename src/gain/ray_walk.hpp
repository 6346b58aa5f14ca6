// What every implementation of the caster works on: rays in lattice units around the origin's
// voxel, and the bricks in reach as one small dense table.
#pragma once

#include <cstdint>
#include <vector>

#include "map/brick.hpp"
#include "nbvopt/gain/ray_caster.hpp"

namespace nbvopt::detail {

/// The brick that holds a voxel; keys may lie off the lattice, where nothing is known.
inline BrickKey brick_at(const Eigen::Vector3i& key) {
  return {key.x() >> kBrickBits, key.y() >> kBrickBits, key.z() >> kBrickBits};
}

/// The bricks that a bundle can touch, x running fastest.
struct LocalBricks {
  BrickKey min;  ///< the first brick
  int size_x = 0, size_y = 0, size_z = 0;
  std::vector<const Brick*> brick;
  std::vector<const std::uint8_t*> code;  ///< of each brick

  int place_of(BrickKey key) const {
    return (key.x - min.x) + size_x * ((key.y - min.y) + size_y * (key.z - min.z));
  }
};

/// The boxes that hold all rays, relative to the origin, metres, map axes, and their shortest
/// and longest ranges.
struct RayBounds {
  Eigen::Vector3d far_min = Eigen::Vector3d::Zero();  ///< from the origin to range_max
  Eigen::Vector3d far_max = Eigen::Vector3d::Zero();
  Eigen::Vector3d near_min = Eigen::Vector3d::Zero();  ///< from the origin to range_min
  Eigen::Vector3d near_max = Eigen::Vector3d::Zero();
  double shortest_range_min_m = 0.0;
  double shortest_range_max_m = 0.0;
  double longest_range_max_m = 0.0;
};

/// A bundle ready to be walked.
struct RayWalk {
  const RayBundle* rays = nullptr;
  double resolution_m = 0.0;
  /// The origin within its voxel, in voxels, each in [0, 1).
  Eigen::Vector3d origin_in_voxel = Eigen::Vector3d::Zero();
  /// The key of the origin's voxel.
  Eigen::Vector3i origin_key = Eigen::Vector3i::Zero();
  double shortest_range_min_m = 0.0;
  double shortest_range_max_m = 0.0;
  LocalBricks bricks;
  bool walk_near = false;  ///< something occupied is near: walk from the origin to range_min too
  bool look_up_uncertainty = false;   ///< some bricks store u
  double occupied_uncertainty = 1.0;  ///< u of occupied voxels in bricks that store none
};

/// Makes the bricks in the rays' bounds ready.
RayWalk make_walk(const VoxelGrid& grid, const RayBundle& rays, double occupied_uncertainty,
                  const RayBounds& bounds);

/// The instruction sets that Highway may use at a level, as its bits; 0: any.
std::int64_t hwy_targets(SimdLevel level);
/// Those of the targets that this machine has; 0: all that it has.
std::int64_t supported_targets(std::int64_t targets);

/// An implementation of the caster. Walking is mirrored: along each axis that a ray goes down,
/// coordinates are negated and a voxel v becomes ~v, so that every ray goes up.
struct CasterKernel {
  /// Fills the hits' directions in the map frame, and bounds the rays.
  RayBounds (*rotate_and_bound)(const RayBundle& rays, RayHits& hits);
  /// Fills the rest of the hits.
  void (*walk)(const RayWalk& walk, RayHits& hits);
};

/// Directions shorter than this along an axis never reach the next voxel in range.
inline constexpr double kSmallestDirection = 1e-12;

CasterKernel scalar_kernel();

/// The vectorised kernel for the best of these Highway targets that the machine has; 0: any.
CasterKernel simd_kernel(std::int64_t targets);
/// The Highway targets that the vectorised kernel was compiled for.
std::int64_t simd_kernel_targets();

}  // namespace nbvopt::detail
