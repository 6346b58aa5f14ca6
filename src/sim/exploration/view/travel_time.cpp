#include "sim/exploration/view/travel_time.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

double travel_time_s(const BaseOptions& base, double yaw_rad, const Path& path) {
  constexpr double kFullSpeed_rad = std::numbers::pi / 3.0;
  const std::vector<Eigen::Vector2d> corners_m = path.rest(0.0);
  double time_s = path.length_m() / base.speed_max_m_s;
  for (std::size_t i = 1; i < corners_m.size(); ++i) {
    const Eigen::Vector2d way_m = corners_m[i] - corners_m[i - 1];
    if (way_m.isZero(0.0)) continue;
    const double heading_rad = std::atan2(way_m.y(), way_m.x());
    const double turn_rad = std::abs(wrap_angle(heading_rad - yaw_rad));
    time_s += std::max(0.0, turn_rad - kFullSpeed_rad) / base.turn_rate_max_rad_s;
    yaw_rad = heading_rad;
  }
  return time_s;
}

}  // namespace nbvopt
