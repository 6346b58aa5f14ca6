// What one scan says about the voxels of a part of the lattice.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "map/segment_walk.hpp"
#include "map/shaft.hpp"
#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

/// What a scan says of a voxel; one bit each, so that a block's content is the OR of its voxels'.
enum Mark : std::uint8_t { kUntouched = 1, kPassed = 2, kHit = 4 };  // NOLINT: bits

/// All that one scan saw of one voxel that it hit.
struct HitVoxel {
  float uncertainty = kUnknownUncertainty;  ///< the minimum over the voxel's points
  std::array<std::uint32_t, 3> colour_sum{};
  std::uint32_t coloured_points = 0;
};

/// A box of tiles, each a cube of voxels aligned with the octree. Voxels are numbered tile by tile
/// and in Morton order within, so that an octree's node is a range of numbers.
class MarkWindow {
 public:
  static constexpr int kTileBits = 6;
  static constexpr int kTileSize = 1 << kTileBits;  ///< voxels an axis

  /// The tile of `least` is the first of tiles[0] x tiles[1] x tiles[2]. Nothing is marked.
  MarkWindow(VoxelKey least, const std::array<int, 3>& tiles);

  /// Marks a voxel of the window as hit and returns its place in hit_voxels(); call before all
  /// segments.
  std::uint32_t mark_hit(VoxelKey key);
  std::span<HitVoxel> hit_voxels() { return hits_; }

  /// Marks what the segment pierces in these slabs within the window as passed. Many threads may do
  /// so while others look for what is not marked.
  void mark_passed(SegmentWalk walk, SlabRange slabs);

  /// Appends those of the slabs in which some voxel that the shaft touches is not marked.
  void find_unmarked(const Shaft& shaft, SlabRange slabs, std::vector<SlabRange>& unmarked);

  /// Lets hits win over passed, and makes content() ready; call when all is marked.
  void finish();

  /// The OR of the marks in a block of 8^level voxels; a tile is a block of level kTileBits.
  std::uint8_t content(int level, std::uint32_t block) const { return content_[level][block]; }

  /// content() of all blocks of a level.
  std::span<const std::uint8_t> contents(int level) const { return content_[level]; }

  const HitVoxel& hit(std::uint32_t number) const { return hits_[hit_of_[number]]; }

  std::uint32_t tile_count() const {
    return static_cast<std::uint32_t>(content_[kTileBits].size());
  }
  VoxelKey key(std::uint32_t number) const;

 private:
  std::array<const std::uint32_t*, 3> part_by_key() const;

  VoxelKey least_;
  std::array<int, 3> tiles_;
  /// A voxel's number is the sum of one entry an axis, found by its key from one before the
  /// window on. A key just outside stands for the one just inside, where rounding left it.
  std::array<std::vector<std::uint32_t>, 3> number_part_;
  std::array<std::vector<std::uint8_t>, kTileBits + 1> content_;  ///< by level
  std::unique_ptr<std::uint32_t[]> hit_of_;  ///< by number; set where a hit is marked
  std::vector<HitVoxel> hits_;
  std::vector<std::uint32_t> hit_numbers_;
};

}  // namespace nbvopt
