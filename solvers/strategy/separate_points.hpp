// The best points that do not crowd together.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt {

/// Indices of at most `count` of `points` (a column each), best value first, none nearer than
/// `separation` to a better one: the largest difference of a coordinate, in shares of the box's
/// width, the short way round where a coordinate is periodic. Points whose value is NaN are left
/// out; of equal values the first counts as better.
std::vector<std::size_t> separate_points(const Objective& objective,
                                         const Eigen::Ref<const Eigen::MatrixXd>& points,
                                         std::span<const double> values, double separation,
                                         std::size_t count);

}  // namespace nbvopt
