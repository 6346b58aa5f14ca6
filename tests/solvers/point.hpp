// Points written as lists.
#pragma once

#include <algorithm>
#include <initializer_list>

#include "nbvopt/solver/objective.hpp"

namespace nbvopt::test {

inline Point point(std::initializer_list<double> coordinates) {
  Point x(static_cast<Eigen::Index>(coordinates.size()));
  std::copy(coordinates.begin(), coordinates.end(), x.begin());
  return x;
}

}  // namespace nbvopt::test
