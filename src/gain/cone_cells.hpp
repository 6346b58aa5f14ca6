// What rays from anywhere in a box of origins can bring at most, by direction: cells of azimuth and
// elevation, a cone each.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "gain/cone_march.hpp"
#include "nbvopt/core/stop.hpp"

namespace nbvopt::detail {

/// A rectangle of cells, both ends included.
struct CellBox {
  int azimuth_min = 0, azimuth_max = -1;
  int elevation_min = 0, elevation_max = -1;

  int wide() const { return azimuth_max - azimuth_min + 1; }
  int high() const { return elevation_max - elevation_min + 1; }
};

/// How cells lie: square, `cell_rad` wide, cell (i, j) from azimuth `azimuth_rad` + i * cell_rad
/// and elevation j * cell_rad on, in a frame that R_map turns into the map's axes.
struct CellFrame {
  Eigen::Matrix3d R_map = Eigen::Matrix3d::Identity();
  double azimuth_rad = 0.0;
  double cell_rad = 0.0;
};

/// Cells are filled in tiles. What is not filled holds a value that no ray exceeds.
class ConeCells {
 public:
  /// Over the cells of the box, from origins by their places in the grid of cones.
  ConeCells(const CellFrame& frame, const CellBox& box, const Eigen::Vector3d& origin_min,
            const Eigen::Vector3d& origin_max);

  /// Fills the tiles of those of the cells that lie in the box. `coarser` has cells twice as wide
  /// in the same frame, and origins that hold these, or is null: cones begin where its cones were
  /// clear, and settled ones are taken over. Returns whether it came to an end before it was to
  /// stop.
  bool fill(const CellBox& cells, const ConeCells* coarser, const ConeGrid& grid,
            const ConeMarch& march, const StopRule& stop);

  /// The largest value over 2 x 2 cells from every cell of a part of the box on, row by row, and
  /// some more numbers behind the last, so that vectors may be read from its end.
  std::vector<float> windows(const CellBox& part) const;

  std::int64_t cones() const { return cones_; }
  std::size_t memory_bytes() const { return cells_.capacity() * sizeof(Cell); }

 private:
  static constexpr int kTileBits = 4;
  static constexpr int kTile = 1 << kTileBits;
  static constexpr int kTileCells = kTile * kTile;

  /// A view of a cone in four bytes, values rounded up, free lengths down.
  class Cell {
   public:
    Cell() = default;
    explicit Cell(const ConeView& view);

    float value() const { return value_ * kValueStep - 1.0F; }
    double clear() const { return (clear_ & ~kSettledBit) * kClearStep; }
    bool is_settled() const { return (clear_ & kSettledBit) != 0; }

   private:
    static constexpr float kValueStep = 0x1p-14F;
    static constexpr double kClearStep = 0x1p-4;  // voxels
    static constexpr std::uint16_t kSettledBit = 0x8000;

    std::uint16_t value_ = 0;  ///< no ray brings more before the angle's part is taken off
    std::uint16_t clear_ = 0;  ///< how far nothing can be hit
  };

  const Cell* find(int azimuth, int elevation) const;
  void fill_tile(int azimuth, int elevation, Cell* cells, const ConeCells* coarser,
                 const ConeGrid& grid, const ConeMarch& march);

  CellFrame frame_;
  CellBox box_;
  Eigen::Vector3d origin_min_, origin_max_;
  int tiles_wide_, tiles_high_;
  std::vector<std::int32_t> tile_;  ///< place of each tile's cells; -1 where it is not filled
  std::vector<Cell> cells_;
  std::int64_t cones_ = 0;
};

}  // namespace nbvopt::detail
