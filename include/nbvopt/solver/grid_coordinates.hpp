// The candidates of the paper's grid along one coordinate.
#pragma once

#include <vector>

namespace nbvopt {

/// Algorithm 2: lower, lower + step, ... up to upper. Requires step > 0.
std::vector<double> grid_coordinates(double lower, double upper, double step);

}  // namespace nbvopt
