// Where a strategy looks first, and from which points it goes on.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

inline constexpr int kMostFreeCoordinates = 8;

/// Most optima lie on a face of the box, which samples of its inside never meet. So these are the
/// corners, the centres of edges, faces and the box (3^d points), and `line_points` points
/// evenly spread inside each line through three of them that runs along coordinate 0. A frozen
/// coordinate has one value, the ends of a periodic one are one point, and no point comes twice.
/// Throws UsageError when more than kMostFreeCoordinates can move.
std::vector<Point> start_points(const Objective& objective, int line_points);

/// Indices of at most `count` of `points` (a column each), best value first, none nearer than
/// `separation` to a better one: the largest difference of a coordinate, in shares of the box's
/// width, the short way round where a coordinate is periodic. Points whose value is NaN are left
/// out; of equal values the first counts as better.
std::vector<std::size_t> separate_points(const Objective& objective,
                                         const Eigen::Ref<const Eigen::MatrixXd>& points,
                                         std::span<const double> values, double separation,
                                         std::size_t count);

}  // namespace nbvopt
