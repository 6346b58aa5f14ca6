#include "nbvopt/map/colour_ramp.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {

std::array<std::uint8_t, 3> uncertainty_colour(double uncertainty) {
  // Full saturation and value: hue 0 (red) at u = 1, 60 (yellow) at 0.5, 120 degrees (green) at 0.
  const double u = std::clamp(uncertainty, 0.0, 1.0);
  const auto channel = [](double part) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, 2.0 * part)));
  };
  return {channel(u), channel(1.0 - u), 0};
}

}  // namespace nbvopt
