// Driving to one place.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "sim/exploration/plane_robot.hpp"

namespace nbvopt {

enum class Arrival {
  arrived,
  barred,  ///< there is no way, as far as is known
  late,    ///< the time was up on the way
};

/// Drives to a goal through what is not known to be barred, planning again as the lidar shows more,
/// until then at most; tells of each scan on the way.
Arrival reach(PlaneRobot& robot, const DriveCosts& costs, const Eigen::Vector2d& goal_map_m,
              double until_s, const std::function<void()>& on_scan);

}  // namespace nbvopt
