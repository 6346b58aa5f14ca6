#include "map/insertion_size.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "map/brick.hpp"
#include "nbvopt/map/voxel.hpp"

namespace nbvopt {

namespace {

/// A list that grows holds twice what it needs for a moment, and the grid sorts a copy by bricks.
constexpr std::uint64_t kBytesPerVoxel = 4 * sizeof(VoxelChange);

/// A block whose voxels differ has eight children at most, and their array; malloc() rounds up.
constexpr std::uint64_t kBytesPerMixedBlock = 8 * 32 + 80;

/// The brick itself and, of those around that are made anew, one.
constexpr std::uint64_t kBytesPerBrick = 2 * 45'000;

/// Of the blocks of a level.
struct BlockCounts {
  std::uint64_t touched = 0;
  std::uint64_t mixed = 0;  ///< neither untouched nor passed altogether
};

/// One in the lowest bit of each byte.
constexpr std::uint64_t kOnes = 0x0101'0101'0101'0101;

std::uint64_t sum_of_bytes(std::uint64_t bytes) {
  constexpr std::uint64_t kEven = 0x00FF'00FF'00FF'00FF;
  return ((bytes & kEven) + (bytes >> 8 & kEven)) * 0x0001'0001'0001'0001 >> 48;
}

/// Eight blocks a step, since a scan has a hundred thousand; their number is a multiple of eight.
BlockCounts count_blocks(std::span<const std::uint8_t> blocks) {
  static_assert(kUntouched == 1 && kPassed == 2 && kHit == 4);
  constexpr std::size_t kMostSteps = 255;  // until a byte is full
  BlockCounts counts;
  for (std::size_t i = 0; i < blocks.size();) {
    const std::size_t end = std::min(blocks.size(), i + 8 * kMostSteps);
    std::uint64_t touched = 0;
    std::uint64_t mixed = 0;
    for (; i < end; i += 8) {
      std::uint64_t marks = 0;
      std::memcpy(&marks, &blocks[i], 8);
      touched += (marks >> 1 | marks >> 2) & kOnes;
      mixed += (marks >> 2 | (marks & marks >> 1)) & kOnes;
    }
    counts.touched += sum_of_bytes(touched);
    counts.mixed += sum_of_bytes(mixed);
  }
  return counts;
}

}  // namespace

std::uint64_t most_bytes_to_insert(const MarkWindow& window) {
  std::array<BlockCounts, MarkWindow::kTileBits> of_level;
  std::uint64_t mixed_blocks = window.tile_count();
  for (int level = 1; level < MarkWindow::kTileBits; ++level) {
    of_level[level] = count_blocks(window.contents(level));
    mixed_blocks += of_level[level].mixed;
  }
  return 8 * of_level[1].touched * kBytesPerVoxel + mixed_blocks * kBytesPerMixedBlock +
         of_level[detail::kBrickBits].touched * kBytesPerBrick;
}

}  // namespace nbvopt
