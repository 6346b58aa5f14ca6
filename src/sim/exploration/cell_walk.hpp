// Which cells a straight line crosses.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "nbvopt/sim/cell_array.hpp"

namespace nbvopt {

/// One axis of a walk.
struct CellWalkAxis {
  CellWalkAxis(double from, double to)
      : cell(static_cast<int>(std::floor(from))), left(static_cast<int>(std::floor(to)) - cell) {
    if (left == 0) return;
    const double length = to - from;
    step = left > 0 ? 1 : -1;
    left = std::abs(left);
    crossing = (cell + (step > 0 ? 1 : 0) - from) / length;
    spacing = 1.0 / std::abs(length);
  }

  void advance() {
    cell += step;
    // Counting the steps on each axis ends the walk in the last cell, whatever is rounded.
    crossing = --left > 0 ? crossing + spacing : std::numeric_limits<double>::infinity();
  }

  int cell;
  int left;  ///< steps to go
  int step = 0;
  /// Where the line crosses the next cell border on the axis: 0 at `from`, 1 at `to`.
  double crossing = std::numeric_limits<double>::infinity();
  double spacing = 0.0;
};

/// Visits the cells that the segment pierces, in order, each once and each an edge's neighbour of
/// the one before; from the cell of `from` to the cell of `to`, both included. Coordinates are in
/// cells. visit(cell) returns whether to go on.
template <class Visit>
void walk_cells(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Visit& visit) {
  CellWalkAxis x(from.x(), to.x());
  CellWalkAxis y(from.y(), to.y());
  while (visit(Cell(x.cell, y.cell)) && x.left + y.left > 0) {
    if (x.crossing < y.crossing) {
      x.advance();
    } else {
      y.advance();
    }
  }
}

}  // namespace nbvopt
