#include "map/mark_window.hpp"

#include <algorithm>
#include <cstring>

namespace nbvopt {

namespace {

constexpr int kTileBits = MarkWindow::kTileBits;
constexpr int kTileSize = MarkWindow::kTileSize;
constexpr std::uint32_t kTileVoxels = 1U << 3 * kTileBits;

/// Bit i of a coordinate within the tile goes to bit 3 i + axis of the number, and back.
std::uint32_t spread_bits(int coordinate, int axis) {
  std::uint32_t number = 0;
  for (int i = 0; i < kTileBits; ++i) {
    number |= static_cast<std::uint32_t>(coordinate >> i & 1) << (3 * i + axis);
  }
  return number;
}

int gathered_bits(std::uint32_t number, int axis) {
  int coordinate = 0;
  for (int i = 0; i < kTileBits; ++i) {
    coordinate |= static_cast<int>(number >> (3 * i + axis) & 1) << i;
  }
  return coordinate;
}

}  // namespace

MarkWindow::MarkWindow(VoxelKey least, const std::array<int, 3>& tiles)
    : least_(least), tiles_(tiles) {
  std::uint32_t tile_count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const int size = tiles[axis] * kTileSize;
    for (int i = -1; i <= size; ++i) {
      const int inside = std::clamp(i, 0, size - 1);
      number_part_[axis].push_back(static_cast<std::uint32_t>(inside >> kTileBits) * tile_count *
                                       kTileVoxels +
                                   spread_bits(inside, axis));
    }
    tile_count *= static_cast<std::uint32_t>(tiles[axis]);
  }
  content_[0].assign(std::size_t{tile_count} * kTileVoxels, kUntouched);
  for (int level = 1; level <= kTileBits; ++level) {
    content_[level].resize(content_[0].size() >> 3 * level);
  }
  hit_of_ = std::make_unique_for_overwrite<std::uint32_t[]>(content_[0].size());
}

void MarkWindow::mark_passed(SegmentWalk walk) {
  const Eigen::Vector3d least(least_.x, least_.y, least_.z);
  const Eigen::Vector3d size(tiles_[0] * kTileSize, tiles_[1] * kTileSize, tiles_[2] * kTileSize);
  if (!walk.clip(least, least + size)) return;
  std::array<const std::uint32_t*, 3> part_by_key;
  for (int axis = 0; axis < 3; ++axis) {
    part_by_key[axis] = number_part_[axis].data() + 1 - static_cast<std::ptrdiff_t>(least[axis]);
  }
  walk.for_each_cell(
      part_by_key, [marks = content_[0].data()](std::uint32_t number) { marks[number] = kPassed; });
}

HitVoxel& MarkWindow::mark_hit(VoxelKey key) {
  const std::uint32_t number = number_part_[0][key.x - least_.x + 1] +
                               number_part_[1][key.y - least_.y + 1] +
                               number_part_[2][key.z - least_.z + 1];
  if (content_[0][number] != kHit) {
    content_[0][number] = kHit;
    hit_of_[number] = static_cast<std::uint32_t>(hits_.size());
    hits_.emplace_back();
  }
  return hits_[hit_of_[number]];
}

void MarkWindow::summarise() {
  for (int level = 1; level <= kTileBits; ++level) {
    const std::uint8_t* children = content_[level - 1].data();
    for (std::uint8_t& block : content_[level]) {
      std::uint64_t marks = 0;
      std::memcpy(&marks, children, 8);
      marks |= marks >> 32;
      marks |= marks >> 16;
      marks |= marks >> 8;
      block = static_cast<std::uint8_t>(marks);
      children += 8;
    }
  }
}

VoxelKey MarkWindow::key(std::uint32_t number) const {
  const int tile = static_cast<int>(number / kTileVoxels);
  const std::array<int, 3> tile_at{tile % tiles_[0], tile / tiles_[0] % tiles_[1],
                                   tile / tiles_[0] / tiles_[1]};
  const auto coordinate = [&](std::uint16_t least, int axis) {
    return static_cast<std::uint16_t>(least + tile_at[axis] * kTileSize +
                                      gathered_bits(number, axis));
  };
  return {coordinate(least_.x, 0), coordinate(least_.y, 1), coordinate(least_.z, 2)};
}

}  // namespace nbvopt
