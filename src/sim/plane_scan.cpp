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

void end_at_people(const PeopleScene& people, const SimulatedLidar& lidar,
                   const Transform& T_world_base, std::vector<PlaneBeam>& beams) {
  std::vector<Eigen::Vector3f> directions;
  std::vector<float> lengths_m;
  for (const PlaneBeam& beam : beams) {
    const Eigen::Vector2d direction = beam.end_base_m.normalized();
    directions.push_back(
        (T_world_base.linear() * Eigen::Vector3d(direction.x(), direction.y(), 0.0)).cast<float>());
    lengths_m.push_back(static_cast<float>(beam.end_base_m.norm()));
  }
  std::vector<float> seen_m = lengths_m;
  people.shorten(T_world_base * Eigen::Vector3d(0.0, 0.0, lidar.options().height_m), directions,
                 static_cast<float>(lidar.options().range_max_m), seen_m);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (seen_m[i] == lengths_m[i]) continue;
    beams[i] = {beams[i].end_base_m.normalized() * seen_m[i], false};
  }
}

}  // namespace nbvopt
