// Plans by another gain than the server's robot has.
#pragma once

#include <memory>

#include "nbvopt/planner/view_planner.hpp"

namespace nbvopt {

/// A planner on the same grid and with the same hazards, the published one where that is its gain.
inline std::shared_ptr<const ViewPlanner> planner_by_gain(
    std::shared_ptr<const ViewPlanner> published, const GainChoice& gain) {
  if (published->robot().sensor.gain == gain) return published;
  Robot robot = published->robot();
  robot.sensor.gain = gain;
  return std::make_shared<const ViewPlanner>(published->grid(), robot, published->hazards());
}

}  // namespace nbvopt
