// Normal random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "core/uniform.hpp"

namespace nbvopt {

/// Of mean 0 and standard deviation 1, by Box and Muller's method: two draws of the generator each.
/// std::normal_distribution differs between standard libraries.
inline double standard_normal(std::mt19937_64& generator) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(generator)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(generator));
}

}  // namespace nbvopt
