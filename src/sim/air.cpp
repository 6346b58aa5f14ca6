#include "sim/air.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace nbvopt {

double air_above_m3(const Scene& scene, const Eigen::Vector3d& origin_map_m, double range_max_m) {
  constexpr int kRays = 512;
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < kRays; ++i) {  // a spiral of equal areas on the half sphere
    const double z = (i + 0.5) / kRays;
    const double angle_rad = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(static_cast<float>(radius * std::cos(angle_rad)),
                            static_cast<float>(radius * std::sin(angle_rad)),
                            static_cast<float>(z));
  }
  std::vector<float> distances_m(directions.size());
  scene.first_hits(origin_map_m, directions, static_cast<float>(range_max_m), distances_m);
  double air_m3 = 0.0;
  for (const double distance_m : distances_m) {
    air_m3 += 2.0 * std::numbers::pi / kRays * distance_m * distance_m * distance_m / 3.0;
  }
  return air_m3;
}

}  // namespace nbvopt
