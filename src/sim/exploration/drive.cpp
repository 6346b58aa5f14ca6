#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/plane_robot.hpp"
#include "sim/exploration/reach.hpp"

namespace nbvopt {
namespace {

/// The way is searched in the box of all that is known and the goal: a larger one would not fit
/// into memory.
constexpr double kFarthestGoal_m = 200.0;

}  // namespace

Exploration drive_to(const Scene& scene, const Transform& T_map_base,
                     std::span<const Eigen::Vector2d> goals_map_m,
                     const ExplorationOptions& options) {
  for (std::size_t i = 0; i < goals_map_m.size(); ++i) {
    if (!goals_map_m[i].allFinite()) {
      throw InputError("goal " + std::to_string(i + 1) + " is not finite, give x and y in metres");
    }
  }
  PlaneRobot robot(scene, T_map_base, options);
  const DriveRegion region(options);
  const DriveCosts costs = robot.drive_costs(/*through_unknown=*/true);
  ExplorationStatus status = ExplorationStatus::complete;
  for (std::size_t i = 0; i < goals_map_m.size() && status == ExplorationStatus::complete; ++i) {
    const Eigen::Vector2d& goal_map_m = goals_map_m[i];
    const double distance_m = (goal_map_m - robot.position_map_m()).norm();
    const std::string name = "goal " + std::to_string(i + 1) + " (" +
                             format_number(goal_map_m.x()) + ", " + format_number(goal_map_m.y()) +
                             ")";
    if (!region.contains(goal_map_m)) throw InputError(name + " lies outside of the region");
    if (distance_m > kFarthestGoal_m) {
      throw InputError(name + " is " + format_number(std::round(distance_m)) +
                       " m away, it must be at most 200 m: give others on the way");
    }
    const Arrival arrival = reach(robot, costs, goal_map_m, options.duration_max_s, [] {});
    if (arrival == Arrival::barred) {
      throw InputError(name +
                       " cannot be reached: it is too near to a surface or walled off, "
                       "choose one in free space");
    }
    if (arrival == Arrival::late) status = ExplorationStatus::time_limit;
  }
  robot.stop();
  return {status, robot.trajectory(), robot.grid()};
}

}  // namespace nbvopt
