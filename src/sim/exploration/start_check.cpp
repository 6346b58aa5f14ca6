#include "sim/exploration/start_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// A mesh does not say what is solid. But a wardrobe, a crate or a bed holds less air than this,
/// and a room that is worth exploring more.
constexpr double kLeastAir_cubic_m = 4.0;
constexpr int kAirRays = 512;

/// The air that is seen from the lidar in the upper half space; +inf under the open sky.
double air_above_m3(const Scene& scene, const Transform& T_map_base, const LidarOptions& lidar) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < kAirRays; ++i) {  // a spiral of equal areas on the half sphere
    const double z = (i + 0.5) / kAirRays;
    const double angle_rad = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    directions.emplace_back(static_cast<float>(radius * std::cos(angle_rad)),
                            static_cast<float>(radius * std::sin(angle_rad)),
                            static_cast<float>(z));
  }
  std::vector<float> distances_m(directions.size());
  scene.first_hits(T_map_base * Eigen::Vector3d(0.0, 0.0, lidar.height_m), directions,
                   static_cast<float>(lidar.range_max_m), distances_m);
  double air_m3 = 0.0;
  for (const double distance_m : distances_m) {
    air_m3 += 2.0 * std::numbers::pi / kAirRays * distance_m * distance_m * distance_m / 3.0;
  }
  return air_m3;
}

}  // namespace

void require_free_start(const Scene& scene, const Transform& T_map_base,
                        const ExplorationOptions& options) {
  const Eigen::Vector3d position_map_m = T_map_base.translation();
  const auto refuse = [&](const std::string& what) {
    throw InputError("the start (" + format_number(position_map_m.x()) + ", " +
                     format_number(position_map_m.y()) + ") " + what);
  };
  if (!T_map_base.matrix().allFinite()) refuse("is not finite");
  constexpr double kFarthest_m = 10'000.0;  // the plane's cells are counted from the map's origin
  if (position_map_m.cwiseAbs().maxCoeff() > kFarthest_m) {
    refuse("is more than 10 km from the map's origin, check its unit");
  }
  if (!T_map_base.linear().col(2).isApprox(Eigen::Vector3d::UnitZ(), 1e-6)) {
    refuse("leans, a base explores the plane upright");
  }
  const std::vector<float> ranges_m = SimulatedLidar(scene, options.lidar).scan(T_map_base);
  const double nearest_m = *std::ranges::min_element(ranges_m);
  if (nearest_m < options.base.radius_m) {
    refuse("is nearer to a surface than the base's radius of " +
           format_number(options.base.radius_m) + " m, start where there is room");
  }
  if (air_above_m3(scene, T_map_base, options.lidar) < kLeastAir_cubic_m) {
    refuse("is inside a wall or a piece of furniture, start where there is room");
  }
}

}  // namespace nbvopt
