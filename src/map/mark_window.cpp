#include "map/mark_window.hpp"

#include <algorithm>
#include <atomic>
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

std::array<const std::uint32_t*, 3> MarkWindow::part_by_key() const {
  const std::array<int, 3> least{least_.x, least_.y, least_.z};
  std::array<const std::uint32_t*, 3> part_by_key;
  for (int axis = 0; axis < 3; ++axis) {
    part_by_key[axis] = number_part_[axis].data() + 1 - static_cast<std::ptrdiff_t>(least[axis]);
  }
  return part_by_key;
}

void MarkWindow::mark_passed(SegmentWalk walk, SlabRange slabs) {
  const Eigen::Vector3d least(least_.x, least_.y, least_.z);
  const Eigen::Vector3d size(tiles_[0] * kTileSize, tiles_[1] * kTileSize, tiles_[2] * kTileSize);
  if (!walk.clip(least, least + size)) return;
  walk.for_each_cell_of(slabs, part_by_key(), [marks = content_[0].data()](std::uint32_t number) {
    marks[number] = kPassed;
  });
}

void MarkWindow::find_unmarked(const Shaft& shaft, SlabRange slabs,
                               std::vector<SlabRange>& unmarked) {
  const std::array<int, 3> least{least_.x, least_.y, least_.z};
  const auto inside = [&](int axis, int key) {
    return std::clamp(key, least[axis], least[axis] + tiles_[axis] * kTileSize - 1);
  };
  const auto parts = part_by_key();
  const int a = shaft.axis();
  const int b = (a + 1) % 3;
  const int c = (a + 2) % 3;
  const int first = std::max({slabs.first, shaft.slabs().first, least[a]});
  const int last = std::min({slabs.last, shaft.slabs().last, least[a] + tiles_[a] * kTileSize - 1});
  const auto mark = [marks = content_[0].data()](std::uint32_t number) {
    return std::atomic_ref(marks[number]).load(std::memory_order_relaxed);
  };
  const auto is_marked = [&](int slab) {
    const Shaft::Cells cells = shaft.cells(slab);
    const int first_b = inside(b, cells.first_b);
    const int last_b = inside(b, cells.last_b);
    const int last_c = inside(c, cells.last_c);
    for (int i = inside(c, cells.first_c); i <= last_c; ++i) {
      const std::uint32_t number_ac = parts[a][slab] + parts[c][i];
      for (int j = first_b; j <= last_b; ++j) {
        if (mark(number_ac + parts[b][j]) == kUntouched) return false;
      }
    }
    return true;
  };
  for (int slab = first; slab <= last; ++slab) {
    if (is_marked(slab)) continue;
    if (!unmarked.empty() && unmarked.back().last == slab - 1) {
      unmarked.back().last = slab;
    } else {
      unmarked.push_back({slab, slab});
    }
  }
}

std::uint32_t MarkWindow::mark_hit(VoxelKey key) {
  const std::uint32_t number = number_part_[0][key.x - least_.x + 1] +
                               number_part_[1][key.y - least_.y + 1] +
                               number_part_[2][key.z - least_.z + 1];
  if (content_[0][number] != kHit) {
    content_[0][number] = kHit;
    hit_of_[number] = static_cast<std::uint32_t>(hits_.size());
    hits_.emplace_back();
    hit_numbers_.push_back(number);
  }
  return hit_of_[number];
}

void MarkWindow::finish() {
  for (const std::uint32_t number : hit_numbers_) content_[0][number] = kHit;
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
