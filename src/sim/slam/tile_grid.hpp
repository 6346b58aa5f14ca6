// The map in the plane of one particle.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "nbvopt/sim/cell_array.hpp"
#include "nbvopt/sim/occupancy_grid.hpp"

namespace nbvopt {

/// What beams told of the cells of a square; cell (i, j) at index_in_tile().
struct Tile {
  static constexpr int kCells = 32;  ///< along an edge
  template <class Value>
  using PerCell = std::array<Value, std::size_t{kCells} * kCells>;

  // Apart, since most beams only pass.
  PerCell<std::uint32_t> beams{};           ///< that crossed the cell or ended in it
  PerCell<std::uint32_t> hits{};            ///< that met a surface in it
  PerCell<std::array<float, 2>> hit_sum{};  ///< of the hits, from the cell's least corner, in cells

  /// GMapping's rule: a tenth of the beams met something.
  bool is_occupied(std::size_t cell) const { return 10 * std::uint64_t{hits[cell]} > beams[cell]; }
  /// Of an occupied cell: the mean of its hits, from its least corner, in cells.
  Eigen::Vector2f mean_hit(std::size_t cell) const {
    return Eigen::Vector2f(hit_sum[cell][0], hit_sum[cell][1]) / static_cast<float>(hits[cell]);
  }
};

/// The tile that holds a cell.
inline Cell tile_of(const Cell& cell) {
  static_assert(Tile::kCells == 1 << 5);
  return {cell.x() >> 5, cell.y() >> 5};
}

/// Where a cell is in its tile.
inline std::size_t index_in_tile(const Cell& cell) {
  constexpr int kMask = Tile::kCells - 1;
  return static_cast<std::size_t>((cell.y() & kMask) * Tile::kCells + (cell.x() & kMask));
}

/// Cells in square tiles. Grids that share a history share its tiles: who writes into a tile that
/// another grid may hold, too, copies it first. Grids that share tiles may be written at the same
/// time, each by one thread.
class TileGrid {
 public:
  explicit TileGrid(double cell_m) : cell_m_(cell_m) {}
  TileGrid(TileGrid&&) noexcept = default;
  TileGrid& operator=(TileGrid&&) noexcept = default;

  /// A grid that knows the same; all tiles are shared from now on.
  TileGrid share();

  double cell_m() const { return cell_m_; }

  /// Enters beams from one origin.
  void insert_scan(const Eigen::Vector2d& origin_map_m, std::span<const Beam> beams);

  /// The tile whose cells are [Tile::kCells * tile, Tile::kCells * (tile + 1)); null where no beam
  /// was.
  const Tile* find(const Cell& tile) const;

 private:
  struct Slot {
    std::shared_ptr<Tile> tile;  ///< shared with the grids that share() gave and took
    bool is_own = false;         ///< no other grid holds it
  };

  Tile& writable(Slot& slot);

  double cell_m_;
  CellArray<Slot> slots_{Slot{}, 1};
};

}  // namespace nbvopt
