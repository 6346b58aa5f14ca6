// How much room there is around each cell.
#pragma once

#include <span>
#include <vector>

#include "nbvopt/sim/cell_array.hpp"

namespace nbvopt {

/// The distance from each cell to the nearest occupied one, centre to centre, exact up to a reach
/// and equal to it beyond. Occupied cells remain so, hence distances only shrink and each new cell
/// costs one disc.
class ClearanceField {
 public:
  ClearanceField(double cell_m, double reach_m);

  void add_occupied(std::span<const Cell> cells);

  float clearance_m(const Cell& cell) const { return clearance_m_.at(cell); }

 private:
  struct Offset {
    Cell offset;
    float distance_m;
  };

  int reach_cells_;
  std::vector<Offset> disc_;
  CellArray<float> clearance_m_;
};

}  // namespace nbvopt
