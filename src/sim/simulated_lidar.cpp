#include "nbvopt/sim/simulated_lidar.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

[[noreturn]] void refuse(const std::string& field, double value, const std::string& rule) {
  throw InputError("lidar." + field + " is " + format_number(value) + ", it must be " + rule);
}

}  // namespace

void LidarOptions::validate() const {
  if (beams < 1) refuse("beams", beams, "1 or more");
  if (!(range_min_m >= 0.0)) refuse("range_min_m", range_min_m, "0 or more");
  if (!(range_max_m > range_min_m && std::isfinite(range_max_m))) {
    refuse("range_max_m", range_max_m, "greater than range_min_m and finite");
  }
  if (!std::isfinite(height_m)) refuse("height_m", height_m, "finite");
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
