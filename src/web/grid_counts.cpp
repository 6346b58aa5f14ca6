#include "web/grid_counts.hpp"

#include <bit>

#include "map/brick_table.hpp"
#include "map/map_access.hpp"

namespace nbvopt {
namespace {

void count(const detail::BrickStates& states, MapCounts& counts) {
  for (int row = 0; row < detail::kBrickRows; ++row) {
    counts.occupied_voxels += static_cast<std::uint64_t>(std::popcount(states.occupied[row]));
    counts.free_voxels += static_cast<std::uint64_t>(std::popcount(states.free[row]));
  }
  for (const float uncertainty : states.uncertainty) {
    if (!(uncertainty < kUnknownUncertainty)) continue;
    ++counts.certain_voxels;
    counts.information += 1.0 - static_cast<double>(uncertainty);
  }
}

}  // namespace

MapCounts grid_counts(const VoxelGrid& grid) {
  const detail::BrickTable& table = detail::MapAccess::table(grid);
  MapCounts counts;
  for (const detail::BrickKey& block : table.read_blocks()) {
    constexpr int kBlockSize = 1 << detail::kBlockBits;
    const detail::BrickKey first{block.x * kBlockSize, block.y * kBlockSize, block.z * kBlockSize};
    const detail::BrickBox bricks{
        first, {first.x + kBlockSize - 1, first.y + kBlockSize - 1, first.z + kBlockSize - 1}};
    bricks.for_each([&](detail::BrickKey key) {
      const detail::Brick* brick = table.ready_brick(key);
      if (brick != nullptr) count(*brick->states, counts);
    });
  }
  return counts;
}

}  // namespace nbvopt
