// The paper's reduced HSV ramp for uncertainty: red is uncertain, green is reliable (Fig. 2).
#pragma once

#include <array>
#include <cstdint>

namespace nbvopt {

/// RGB of an uncertainty in [0, 1], clamped.
std::array<std::uint8_t, 3> uncertainty_colour(double uncertainty);

}  // namespace nbvopt
