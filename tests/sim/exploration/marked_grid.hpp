// Occupancy grids drawn by hand.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nbvopt/sim/occupancy_grid.hpp"

namespace nbvopt::test {

/// Marks the cells of a box, from the one that holds min to the one that holds max, as free or
/// occupied. Returns the newly occupied ones.
inline std::vector<Cell> mark(OccupancyGrid& grid, const Eigen::Vector2d& min_m,
                              const Eigen::Vector2d& max_m, CellState state) {
  std::vector<Cell> newly_occupied;
  const Cell min = grid.cell_at(min_m);
  const Cell max = grid.cell_at(max_m);
  for (int y = min.y(); y <= max.y(); ++y) {
    for (int x = min.x(); x <= max.x(); ++x) {
      // A beam that goes nowhere marks the cell that it stands in.
      const Beam beam{grid.centre_map_m({x, y}), state == CellState::occupied};
      const std::vector<Cell> cells = grid.insert_scan(beam.end_map_m, {&beam, 1});
      newly_occupied.insert(newly_occupied.end(), cells.begin(), cells.end());
    }
  }
  return newly_occupied;
}

}  // namespace nbvopt::test
