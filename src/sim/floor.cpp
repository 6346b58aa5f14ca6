#include "nbvopt/sim/floor.hpp"

#include <cmath>

namespace nbvopt {

std::optional<double> floor_height_m(const Scene& scene, const Eigen::Vector3d& above_map_m) {
  constexpr float kDeepest_m = 1000.0F;
  const Eigen::Vector3f down = -Eigen::Vector3f::UnitZ();
  float depth_m = 0.0F;
  scene.first_hits(above_map_m, {&down, 1}, kDeepest_m, {&depth_m, 1});
  if (!std::isfinite(depth_m)) return std::nullopt;
  return above_map_m.z() - depth_m;
}

}  // namespace nbvopt
