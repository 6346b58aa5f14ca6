#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/grid_planner.hpp"
#include "sim/exploration/plane_robot.hpp"

namespace nbvopt {
namespace {

/// The way is searched in the box of all that is known and the goal: a larger one would not fit
/// into memory.
constexpr double kFarthestGoal_m = 200.0;

/// How far beyond all that is known and the goal a way around may lead.
constexpr double kDetour_m = 10.0;

/// The way from the robot to the goal through what is not known to be barred.
std::optional<Path> way_to(const PlaneRobot& robot, const DriveCosts& costs,
                           const Eigen::Vector2d& goal_map_m) {
  const OccupancyGrid& grid = robot.grid();
  Eigen::AlignedBox2i box = grid.bounds();
  box.extend(grid.cell_at(goal_map_m));
  const Cell detour = Cell::Constant(static_cast<int>(kDetour_m / grid.cell_m()));
  return GridPlanner(costs, robot.position_map_m(), {box.min() - detour, box.max() + detour})
      .path(goal_map_m);
}

/// Drives to one goal; false when the time runs out on the way.
bool reach(PlaneRobot& robot, const DriveCosts& costs, const Eigen::Vector2d& goal_map_m,
           const std::string& name) {
  bool needs_way = true;
  while (!robot.is_out_of_time()) {
    if (needs_way || robot.is_path_blocked(costs)) {
      std::optional<Path> path = way_to(robot, costs, goal_map_m);
      if (!path) {
        throw InputError(name +
                         " cannot be reached: it is too near to a surface or walled off, "
                         "choose one in free space");
      }
      robot.follow(std::move(*path));
      needs_way = false;
    }
    if (robot.has_arrived()) return true;
    robot.drive_to_next_scan();
  }
  return false;
}

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
    if (!reach(robot, costs, goal_map_m, name)) status = ExplorationStatus::time_limit;
  }
  robot.stop();
  return {status, robot.trajectory(), robot.grid()};
}

}  // namespace nbvopt
