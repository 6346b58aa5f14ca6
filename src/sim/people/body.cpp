#include "sim/people/body.hpp"

#include <cmath>
#include <numbers>

namespace nbvopt {
namespace {

constexpr double kLegRadius_m = 0.08;
constexpr double kHipHeight_m = 0.85;
constexpr double kHipOffset_m = 0.1;  ///< to either side
constexpr double kSwing_rad = 0.4;    ///< to the front and to the back
constexpr double kStride_m = 1.3;     ///< two steps: feet that do not slide, about

Capsule leg(double side_m, double swing_rad) {
  const Eigen::Vector3d hip_m(0.0, side_m, kHipHeight_m);
  const double length_m = kHipHeight_m - kLegRadius_m;
  return {hip_m, hip_m + length_m * Eigen::Vector3d(std::sin(swing_rad), 0.0, -std::cos(swing_rad)),
          kLegRadius_m};
}

}  // namespace

std::array<Capsule, 3> body_parts(double walked_m) {
  const double swing_rad = kSwing_rad * std::sin(2.0 * std::numbers::pi * walked_m / kStride_m);
  return {
      Capsule{{0.0, 0.0, kBodyRadius_m}, {0.0, 0.0, kBodyHeight_m - kBodyRadius_m}, kBodyRadius_m},
      leg(kHipOffset_m, swing_rad), leg(-kHipOffset_m, -swing_rad)};
}

}  // namespace nbvopt
