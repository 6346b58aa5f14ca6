#include "nbvopt/sim/occupancy_grid.hpp"

#include "core/field_check.hpp"
#include "sim/exploration/cell_walk.hpp"

namespace nbvopt {

OccupancyGrid::OccupancyGrid(double cell_m) : cell_m_(cell_m) {
  check_field(cell_m > 0.0, "cell_m", cell_m, "positive and finite");
}

Cell OccupancyGrid::cell_at(const Eigen::Vector2d& position_map_m) const {
  return (position_map_m / cell_m_).array().floor().cast<int>();
}

Eigen::Vector2d OccupancyGrid::centre_map_m(const Cell& cell) const {
  return (cell.cast<double>() + Eigen::Vector2d::Constant(0.5)) * cell_m_;
}

std::vector<Cell> OccupancyGrid::insert_scan(const Eigen::Vector2d& origin_map_m,
                                             std::span<const Beam> beams) {
  bounds_.extend(cell_at(origin_map_m));
  for (const Beam& beam : beams) bounds_.extend(cell_at(beam.end_map_m));
  states_.reserve(bounds_);

  std::vector<Cell> newly_occupied;
  for (const Beam& beam : beams) {
    const Cell end = cell_at(beam.end_map_m);
    walk_cells(origin_map_m / cell_m_, beam.end_map_m / cell_m_, [&](const Cell& cell) {
      CellState& state = states_[cell];
      if (beam.is_hit && cell == end) {
        if (state != CellState::occupied) newly_occupied.push_back(cell);
        state = CellState::occupied;
      } else if (state == CellState::unknown) {
        state = CellState::free;
      }
      return true;
    });
  }
  return newly_occupied;
}

}  // namespace nbvopt
