// How far voxels are from the surfaces that a grid shows.
#pragma once

#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <unordered_map>
#include <vector>

#include "map/brick.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt::detail {

/// Distances to the nearest occupied voxel, between centres. Computed a brick at a time when first
/// asked for, and kept. Thread-safe.
class SurfaceDistances {
 public:
  /// Up to `reach_m`, or kMostReach voxels where that is less.
  SurfaceDistances(std::shared_ptr<const VoxelGrid> grid, double reach_m);

  static constexpr int kMostReach = 30;

  /// In voxels; infinite beyond the reach.
  double voxels_to_surface(VoxelKey key) const;

  /// Voxels; at least 1.
  int reach() const { return reach_; }

 private:
  /// Squared distances in voxels by index_of(); kFar beyond the reach.
  using BrickDistances = std::vector<std::uint16_t>;
  static constexpr std::uint16_t kFar = 0xFFFF;

  const BrickDistances& distances_of(BrickKey brick) const;
  BrickDistances compute(BrickKey brick) const;

  std::shared_ptr<const VoxelGrid> grid_;
  int reach_;
  mutable std::shared_mutex mutex_;
  /// By the brick's least key; elements stay where they are.
  mutable std::unordered_map<std::uint64_t, BrickDistances> bricks_;
};

}  // namespace nbvopt::detail
