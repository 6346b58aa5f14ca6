// The exploration of explore(), for a robot that is there already.
#pragma once

#include <functional>

#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/plane_robot.hpp"

namespace nbvopt {

/// Explores the plane from where the robot is, and brakes; tells of each scan on the way.
ExplorationStatus explore_plane(PlaneRobot& robot, const ExplorationOptions& options,
                                const std::function<void()>& on_scan);

}  // namespace nbvopt
