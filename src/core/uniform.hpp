// Random numbers that are the same with every standard library.
#pragma once

#include <random>

namespace nbvopt {

/// Uniform in [0, 1). std::uniform_real_distribution differs between standard libraries.
inline double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

}  // namespace nbvopt
