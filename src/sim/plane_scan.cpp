#include "sim/plane_scan.hpp"

#include <cmath>
#include <cstddef>

namespace nbvopt {

std::vector<PlaneBeam> plane_scan(const SimulatedLidar& lidar, const Transform& T_world_base,
                                  double range_max_m) {
  const std::vector<float> ranges_m = lidar.scan(T_world_base);
  std::vector<PlaneBeam> beams;
  beams.reserve(ranges_m.size());
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (ranges_m[i] < 0.0F) continue;
    const bool is_hit = ranges_m[i] < range_max_m;
    const double length_m = is_hit ? ranges_m[i] : range_max_m;
    const double angle_rad = lidar.angle_rad(static_cast<int>(i));
    beams.push_back({{length_m * std::cos(angle_rad), length_m * std::sin(angle_rad)}, is_hit});
  }
  return beams;
}

}  // namespace nbvopt
