#include "sim/slam/tile_grid.hpp"

#include "sim/exploration/cell_walk.hpp"

namespace nbvopt {

TileGrid TileGrid::share() {
  slots_.for_each([](Slot& slot) { slot.is_own = false; });
  TileGrid other(cell_m_);
  other.slots_ = slots_;
  return other;
}

const Tile* TileGrid::find(const Cell& tile) const {
  const Slot* slot = slots_.find(tile);
  return slot == nullptr ? nullptr : slot->tile.get();
}

Tile& TileGrid::writable(Slot& slot) {
  if (!slot.is_own) {
    // Whether others still hold the tile is not asked: the answer would depend on threads.
    slot.tile = slot.tile ? std::make_shared<Tile>(*slot.tile) : std::make_shared<Tile>();
    slot.is_own = true;
  }
  return *slot.tile;
}

void TileGrid::insert_scan(const Eigen::Vector2d& origin_map_m, std::span<const Beam> beams) {
  const auto cell_at = [this](const Eigen::Vector2d& position_map_m) -> Cell {
    return (position_map_m / cell_m_).array().floor().cast<int>();
  };
  Eigen::AlignedBox2i tiles(tile_of(cell_at(origin_map_m)));
  for (const Beam& beam : beams) tiles.extend(tile_of(cell_at(beam.end_map_m)));
  slots_.reserve(tiles);

  Cell last_tile = tiles.min();
  Tile* tile = nullptr;
  for (const Beam& beam : beams) {
    const Eigen::Vector2d end = beam.end_map_m / cell_m_;
    const Cell end_cell = end.array().floor().cast<int>();
    walk_cells(origin_map_m / cell_m_, end, [&](const Cell& cell) {
      if (tile == nullptr || tile_of(cell) != last_tile) {
        last_tile = tile_of(cell);
        tile = &writable(slots_[last_tile]);
      }
      const std::size_t index = index_in_tile(cell);
      ++tile->beams[index];
      if (beam.is_hit && cell == end_cell) {
        ++tile->hits[index];
        tile->hit_sum[index][0] += static_cast<float>(end.x() - cell.x());
        tile->hit_sum[index][1] += static_cast<float>(end.y() - cell.y());
      }
      return true;
    });
  }
}

}  // namespace nbvopt
