#include "nbvopt/sim/simulated_lidar.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/field_check.hpp"

namespace nbvopt {

void LidarOptions::validate() const {
  check_field(beams >= 1, "lidar.beams", beams, "1 or more");
  check_field(range_min_m >= 0.0, "lidar.range_min_m", range_min_m, "0 or more");
  check_field(range_max_m > range_min_m, "lidar.range_max_m", range_max_m,
              "greater than range_min_m and finite");
  check_field(true, "lidar.height_m", height_m, "finite");
}

SimulatedLidar::SimulatedLidar(const Scene& scene, const LidarOptions& options)
    : scene_(scene), options_(options) {
  options.validate();
}

double SimulatedLidar::angle_rad(int beam) const {
  return 2.0 * std::numbers::pi * beam / options_.beams;
}

std::vector<float> SimulatedLidar::scan(const Transform& T_map_base) const {
  const auto beams = static_cast<std::size_t>(options_.beams);
  std::vector<Eigen::Vector3f> directions(beams);
  for (int i = 0; i < options_.beams; ++i) {
    const Eigen::Vector3d direction_base(std::cos(angle_rad(i)), std::sin(angle_rad(i)), 0.0);
    directions[static_cast<std::size_t>(i)] = (T_map_base.linear() * direction_base).cast<float>();
  }
  std::vector<float> ranges_m(beams);
  scene_.first_hits(T_map_base * Eigen::Vector3d(0.0, 0.0, options_.height_m), directions,
                    static_cast<float>(options_.range_max_m), ranges_m);
  for (float& range_m : ranges_m) {
    if (range_m < options_.range_min_m) range_m = -std::numeric_limits<float>::infinity();
  }
  return ranges_m;
}

}  // namespace nbvopt
