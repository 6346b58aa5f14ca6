#include "gain/cone_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nbvopt::detail {
namespace {

/// More than rounding takes off a value, from the march to the sum over rays.
constexpr double kValueRounding = 1e-5;
/// No ray brings more.
constexpr float kNotFilled = 2.0F;
constexpr std::size_t kReadAhead = 64;

/// The cone of a cell. Over a cell a function f lies within (d^2 / 8) (max |f_aa| + max |f_ee|) of
/// its bilinear interpolation, d the cell's width, and that between its corners' values.
Cone cone_of(const ConeGrid& grid, const std::array<Eigen::Vector3d, 4>& corners, double cell_rad,
             const Eigen::Vector3d& origin_min, const Eigen::Vector3d& origin_max) {
  Cone cone;
  Eigen::Vector3d sum = corners[0] + corners[1] + corners[2] + corners[3];
  sum.cwiseAbs().maxCoeff(&cone.across);
  cone.goes_down = sum[cone.across] < 0.0;
  const int row = ConeGrid::row_axis(cone.across);
  const int column = ConeGrid::column_axis(cone.across);
  const double interpolation = 2.0 * cell_rad * cell_rad / 8.0;

  constexpr double kInf = std::numeric_limits<double>::infinity();
  double ahead_min = kInf;
  double ahead_max = 0.0;
  cone.row_slope_min = cone.column_slope_min = kInf;
  cone.row_slope_max = cone.column_slope_max = -kInf;
  for (const Eigen::Vector3d& corner : corners) {
    const double ahead = std::max(1e-3, std::abs(corner[cone.across]));
    const double row_slope = corner[row] / ahead;
    const double column_slope = corner[column] / ahead;
    ahead_min = std::min(ahead_min, ahead);
    ahead_max = std::max(ahead_max, ahead);
    cone.row_slope_min = std::min(cone.row_slope_min, row_slope);
    cone.row_slope_max = std::max(cone.row_slope_max, row_slope);
    cone.column_slope_min = std::min(cone.column_slope_min, column_slope);
    cone.column_slope_max = std::max(cone.column_slope_max, column_slope);
  }
  // No second derivative of a direction is longer than 1.
  ahead_min = std::max(0.1, ahead_min - interpolation);
  ahead_max = std::min(1.0, ahead_max + interpolation);
  // Of a slope s = y / x: |s''| <= sqrt(1 + s^2) (1 + 2 |x'| / x) / x, |x'|^2 <= 1 - x^2.
  const double steepest = std::max({-cone.row_slope_min, cone.row_slope_max, -cone.column_slope_min,
                                    cone.column_slope_max}) +
                          cell_rad;
  const double curvature = std::sqrt(1.0 + steepest * steepest) *
                           (1.0 + 2.0 * std::sqrt(1.0 - ahead_min * ahead_min) / ahead_min) /
                           ahead_min;
  const double slack = curvature * interpolation + 1e-9;
  cone.row_slope_min -= slack;
  cone.row_slope_max += slack;
  cone.column_slope_min -= slack;
  cone.column_slope_max += slack;
  cone.stretch_min = 1.0 / ahead_max;
  cone.stretch_max = 1.0 / ahead_min;

  cone.origin_min = {origin_min[cone.across], origin_min[row], origin_min[column]};
  cone.origin_max = {origin_max[cone.across], origin_max[row], origin_max[column]};
  if (cone.goes_down) {
    cone.origin_min[0] = grid.size(cone.across) - origin_max[cone.across];
    cone.origin_max[0] = grid.size(cone.across) - origin_min[cone.across];
  }
  return cone;
}

}  // namespace

ConeCells::Cell::Cell(const ConeView& view)
    : value_(static_cast<std::uint16_t>(
          std::ceil((view.value + kValueRounding + 1.0) / double{kValueStep}))),
      clear_(
          static_cast<std::uint16_t>(std::min(view.clear / kClearStep, double{kSettledBit - 1}))) {
  if (view.is_settled) clear_ |= kSettledBit;
}

ConeCells::ConeCells(const CellFrame& frame, const CellBox& box, const Eigen::Vector3d& origin_min,
                     const Eigen::Vector3d& origin_max)
    : frame_(frame),
      box_(box),
      origin_min_(origin_min),
      origin_max_(origin_max),
      tiles_wide_((box.wide() + kTile - 1) >> kTileBits),
      tiles_high_((box.high() + kTile - 1) >> kTileBits),
      tile_(static_cast<std::size_t>(tiles_wide_) * static_cast<std::size_t>(tiles_high_), -1) {}

const ConeCells::Cell* ConeCells::find(int azimuth, int elevation) const {
  const int i = azimuth - box_.azimuth_min;
  const int j = elevation - box_.elevation_min;
  if (i < 0 || j < 0 || i >= box_.wide() || j >= box_.high()) return nullptr;
  const std::int32_t tile =
      tile_[static_cast<std::size_t>((j >> kTileBits) * tiles_wide_ + (i >> kTileBits))];
  if (tile < 0) return nullptr;
  return &cells_[static_cast<std::size_t>(tile) * kTileCells +
                 static_cast<std::size_t>((j & (kTile - 1)) * kTile + (i & (kTile - 1)))];
}

bool ConeCells::fill(const CellBox& cells, const ConeCells* coarser, const ConeGrid& grid,
                     const ConeMarch& march, const StopRule& stop) {
  const int x_min = std::max(0, cells.azimuth_min - box_.azimuth_min) >> kTileBits;
  const int x_max = std::min(tiles_wide_ - 1, (cells.azimuth_max - box_.azimuth_min) >> kTileBits);
  const int y_min = std::max(0, cells.elevation_min - box_.elevation_min) >> kTileBits;
  const int y_max =
      std::min(tiles_high_ - 1, (cells.elevation_max - box_.elevation_min) >> kTileBits);
  for (int y = y_min; y <= y_max; ++y) {
    for (int x = x_min; x <= x_max; ++x) {
      std::int32_t& tile = tile_[static_cast<std::size_t>(y * tiles_wide_ + x)];
      if (tile >= 0) continue;
      if (stop.is_expired() || stop.cancel.is_cancelled()) return false;
      tile = static_cast<std::int32_t>(cells_.size() / kTileCells);
      cells_.resize(cells_.size() + kTileCells);
      fill_tile(box_.azimuth_min + x * kTile, box_.elevation_min + y * kTile,
                &cells_[cells_.size() - kTileCells], coarser, grid, march);
    }
  }
  return true;
}

void ConeCells::fill_tile(int azimuth, int elevation, Cell* cells, const ConeCells* coarser,
                          const ConeGrid& grid, const ConeMarch& march) {
  // Directions of cells' corners: those of a row share sine and cosine of the elevation.
  std::array<Eigen::Vector2d, kTile + 1> along;
  for (int i = 0; i <= kTile; ++i) {
    const double az = frame_.azimuth_rad + (azimuth + i) * frame_.cell_rad;
    along[i] = {std::cos(az), std::sin(az)};
  }
  const auto row_of_corners = [&](int j) {
    constexpr double kPole_rad = 0.5 * std::numbers::pi;
    const double el = std::clamp((elevation + j) * frame_.cell_rad, -kPole_rad, kPole_rad);
    std::array<Eigen::Vector3d, kTile + 1> corners;
    for (int i = 0; i <= kTile; ++i) {
      corners[i] = frame_.R_map * Eigen::Vector3d(std::cos(el) * along[i].x(),
                                                  std::cos(el) * along[i].y(), std::sin(el));
    }
    return corners;
  };
  auto above = row_of_corners(0);
  for (int j = 0; j < kTile; ++j) {
    const auto below = std::exchange(above, row_of_corners(j + 1));
    for (int i = 0; i < kTile; ++i) {
      Cell& cell = cells[j * kTile + i];
      const Cell* known =
          coarser != nullptr ? coarser->find((azimuth + i) >> 1, (elevation + j) >> 1) : nullptr;
      if (known != nullptr && known->is_settled()) {
        cell = *known;
        continue;
      }
      Cone cone = cone_of(grid, {below[i], below[i + 1], above[i], above[i + 1]}, frame_.cell_rad,
                          origin_min_, origin_max_);
      if (known != nullptr) cone.clear = known->clear();
      cell = Cell(march(cone));
      ++cones_;
    }
  }
}

std::vector<float> ConeCells::windows(const CellBox& part) const {
  const auto wide = static_cast<std::size_t>(part.wide());
  const auto high = static_cast<std::size_t>(part.high());
  std::vector<float> window(wide * high + kReadAhead, kNotFilled);
  for (int elevation = part.elevation_min; elevation <= part.elevation_max; ++elevation) {
    float* row = &window[static_cast<std::size_t>(elevation - part.elevation_min) * wide];
    for (int azimuth = part.azimuth_min; azimuth <= part.azimuth_max;) {
      // Up to the end of the tile.
      const int end =
          std::min(part.azimuth_max + 1,
                   (((azimuth - box_.azimuth_min) >> kTileBits) + 1) * kTile + box_.azimuth_min);
      if (const Cell* cell = find(azimuth, elevation)) {
        for (int i = azimuth; i < end; ++i) row[i - part.azimuth_min] = (cell++)->value();
      }
      azimuth = end;
    }
  }
  for (std::size_t j = 0; j < high; ++j) {
    float* row = &window[j * wide];
    for (std::size_t i = 0; i + 1 < wide; ++i) row[i] = std::max(row[i], row[i + 1]);
    if (j == 0) continue;
    float* below = row - wide;
    for (std::size_t i = 0; i < wide; ++i) below[i] = std::max(below[i], row[i]);
  }
  return window;
}

}  // namespace nbvopt::detail
