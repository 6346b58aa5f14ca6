// A brick: 32 x 32 x 32 voxels, in the form that rays are cast on.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "nbvopt/map/voxel.hpp"

namespace nbvopt::detail {

inline constexpr int kBrickBits = 5;
inline constexpr int kBrickSize = 1 << kBrickBits;
inline constexpr int kBrickMask = kBrickSize - 1;
inline constexpr int kBrickRows = kBrickSize * kBrickSize;
inline constexpr int kBrickVoxels = kBrickRows * kBrickSize;

/// A brick's address: its voxels' keys divided by 32, each in [0, 2048).
struct BrickKey {
  int x = 0;
  int y = 0;
  int z = 0;

  bool operator==(const BrickKey&) const = default;
};

inline BrickKey brick_of(VoxelKey key) {
  return {key.x >> kBrickBits, key.y >> kBrickBits, key.z >> kBrickBits};
}

/// A voxel's row in its brick (its bit in the row is x & 31).
inline int row_of(VoxelKey key) {
  return (key.y & kBrickMask) | (key.z & kBrickMask) << kBrickBits;
}

/// A voxel's place in its brick, x running fastest.
inline int index_of(VoxelKey key) { return (key.x & kBrickMask) | row_of(key) << kBrickBits; }

/// What the voxels of a brick are: one bit a voxel and state, and u of the occupied ones.
struct BrickStates {
  std::array<std::uint32_t, kBrickRows> occupied{};
  std::array<std::uint32_t, kBrickRows> free{};
  std::array<std::uint16_t, kBrickRows> occupied_before_row{};
  /// u of the occupied voxels in their order; empty when none differs from 1.
  std::vector<float> uncertainty;
  bool has_occupied = false;
  bool has_free = false;

  bool is_all_unknown() const { return !has_occupied && !has_free; }

  VoxelState state(VoxelKey key) const {
    const std::uint32_t bit = 1U << (key.x & kBrickMask);
    const int row = row_of(key);
    if ((occupied[row] & bit) != 0) return VoxelState::occupied;
    return (free[row] & bit) != 0 ? VoxelState::free : VoxelState::unknown;
  }

  /// u of an occupied voxel, `none_stored` where the brick stores none.
  float uncertainty_of_occupied(VoxelKey key, float none_stored) const {
    if (uncertainty.empty()) return none_stored;
    const int row = row_of(key);
    const std::uint32_t before = occupied[row] & ((1U << (key.x & kBrickMask)) - 1U);
    return uncertainty[occupied_before_row[row] + std::popcount(before)];
  }

  /// Completes the fields that follow from `occupied`, `free` and one u a voxel, in index order;
  /// null where none differs from 1.
  void finish(const float* uncertainty_of_voxels);
};

/// One byte a voxel tells a ray what to do. The lower five bits of a free voxel hold 1 + r, r the
/// radius of a cube around it that holds free voxels only (Chebyshev distance, rounded down to a
/// listed radius): a ray inside it may leap to the cube's surface.
///
/// Of voxels at the edge of what is known the code tells which faces they share: an unknown voxel
/// has kBesideSurfaceBit where one of its six neighbours is occupied; a free voxel with an unknown
/// neighbour has kFrontierBit, and kFrontierBesideSurfaceBit too where another is occupied. In a
/// brick of which nothing is known no voxel has them.
inline constexpr std::uint8_t kUnknownCode = 0x80;
inline constexpr std::uint8_t kOccupiedCode = 0xC0;
inline constexpr std::uint8_t kLeapMask = 0x1F;
inline constexpr std::uint8_t kBesideSurfaceBit = 0x20;
inline constexpr std::uint8_t kFrontierBit = 0x20;
inline constexpr std::uint8_t kFrontierBesideSurfaceBit = 0x40;
inline constexpr bool is_free_code(std::uint8_t code) { return code < kUnknownCode; }
inline constexpr bool is_unknown_code(std::uint8_t code) {
  return !is_free_code(code) && code != kOccupiedCode;
}
/// The radius of the cube that a free voxel's code speaks for.
inline constexpr int leap_radius(std::uint8_t code) { return (code & kLeapMask) - 1; }

/// Where a voxel's code stands in its brick: cubes of 4 x 4 x 4 voxels fill a cache line each,
/// since neighbouring rays look at neighbouring voxels.
inline int code_index(VoxelKey key) {
  const int in_cube = (key.x & 3) | (key.y & 3) << 2 | (key.z & 3) << 4;
  const int cube = (key.x >> 2 & 7) | (key.y >> 2 & 7) << 3 | (key.z >> 2 & 7) << 6;
  return in_cube | cube << 6;
}

/// The reach of a brick's codes into its neighbours, voxels.
inline constexpr int kCodeReach = 16;

/// A cast gathers 8 bytes from the address of a code.
inline constexpr int kCodePadding = 8;

struct Brick {
  /// Shared with those bricks of other grid versions that differ in codes only.
  std::shared_ptr<const BrickStates> states;
  /// By code_index().
  alignas(64) std::array<std::uint8_t, kBrickVoxels + kCodePadding> code;
};

/// The brick of which nothing is known.
const std::shared_ptr<const Brick>& unknown_brick();

/// The states of a brick and its 26 neighbours: neighbour (dx, dy, dz), each in {-1, 0, 1}, at
/// (dx + 1) + 3 (dy + 1) + 9 (dz + 1). Never null.
using BrickNeighbourhood = std::array<const BrickStates*, 27>;

/// Computes the codes of the brick in the middle, by code_index().
void compute_codes(const BrickNeighbourhood& neighbourhood, std::uint8_t* code);

}  // namespace nbvopt::detail
