// Which cells a straight line crosses.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "nbvopt/sim/cell_array.hpp"

namespace nbvopt {

/// Visits the cells that the segment pierces, in order, each once and each an edge's neighbour of
/// the one before; from the cell of `from` to the cell of `to`, both included. Coordinates are in
/// cells. visit(cell) returns whether to go on.
template <class Visit>
void walk_cells(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Visit& visit) {
  Cell cell = from.array().floor().cast<int>();
  const Cell last = to.array().floor().cast<int>();
  const Cell step = (last - cell).cwiseSign();
  Cell left = (last - cell).cwiseAbs();
  // Where the line crosses the next cell border on each axis: 0 at `from`, 1 at `to`.
  Eigen::Vector2d crossing = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d spacing = crossing;
  for (int axis = 0; axis < 2; ++axis) {
    if (left[axis] == 0) continue;
    const double length = to[axis] - from[axis];
    crossing[axis] = (cell[axis] + (step[axis] > 0 ? 1 : 0) - from[axis]) / length;
    spacing[axis] = 1.0 / std::abs(length);
  }
  while (visit(cell) && left.sum() > 0) {
    const int axis = crossing.x() < crossing.y() ? 0 : 1;
    cell[axis] += step[axis];
    // Counting the steps on each axis ends the walk in the last cell, whatever is rounded.
    crossing[axis] =
        --left[axis] > 0 ? crossing[axis] + spacing[axis] : std::numeric_limits<double>::infinity();
  }
}

}  // namespace nbvopt
