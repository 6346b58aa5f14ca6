// The map in the plane that a lidar draws while the robot drives.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "nbvopt/sim/cell_array.hpp"

namespace nbvopt {

enum class CellState : std::uint8_t { unknown, free, occupied };

/// How far one lidar beam saw.
struct Beam {
  Eigen::Vector2d end_map_m;
  bool is_hit;  ///< a surface is at its end; otherwise it ends where it was cropped
};

/// Which cells of the plane are free, which occupied. It grows by itself. The lidar is exact and
/// the world stands still, so one hit is proof: an occupied cell remains occupied, even when other
/// beams graze past the surface in it.
class OccupancyGrid {
 public:
  /// Throws InputError unless the cell's edge is positive and finite.
  explicit OccupancyGrid(double cell_m);

  double cell_m() const { return cell_m_; }
  Cell cell_at(const Eigen::Vector2d& position_map_m) const;
  Eigen::Vector2d centre_map_m(const Cell& cell) const;

  /// The cells that scans have reached, bounds included; empty before the first scan.
  const Eigen::AlignedBox2i& bounds() const { return bounds_; }

  /// Unknown wherever no scan has reached.
  CellState state(const Cell& cell) const { return states_.at(cell); }

  /// Marks the cells that beams from one origin pierce as free, those where they hit as occupied.
  /// Returns the cells that were not occupied before and are now.
  std::vector<Cell> insert_scan(const Eigen::Vector2d& origin_map_m, std::span<const Beam> beams);

 private:
  double cell_m_;
  Eigen::AlignedBox2i bounds_;
  CellArray<CellState> states_{CellState::unknown};
};

}  // namespace nbvopt
