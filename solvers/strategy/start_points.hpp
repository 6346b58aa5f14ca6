// Where a strategy looks first. Most optima lie on a face of the box, which samples of its inside
// never meet.
#pragma once

#include <vector>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

inline constexpr int kMostFreeCoordinates = 8;

/// The corners, the centres of edges, faces and the box (3^d points), and `line_points` points
/// evenly spread inside each line through three of them that runs along coordinate 0. A frozen
/// coordinate has one value, the ends of a periodic one are one point, and no point comes twice.
/// Throws UsageError when more than kMostFreeCoordinates can move.
std::vector<Point> start_points(const Objective& objective, int line_points);

}  // namespace nbvopt
