#include "sim/exploration/start_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/air.hpp"

namespace nbvopt {
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
  const Eigen::Vector3d lidar_map_m =
      T_map_base * Eigen::Vector3d(0.0, 0.0, options.lidar.height_m);
  if (air_above_m3(scene, lidar_map_m, options.lidar.range_max_m) < kLeastAir_m3) {
    refuse("is inside a wall or a piece of furniture, start where there is room");
  }
}

}  // namespace nbvopt
