// Numbers that many tests name.
#pragma once

#include <limits>
#include <numbers>

namespace nbvopt::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace nbvopt::test
