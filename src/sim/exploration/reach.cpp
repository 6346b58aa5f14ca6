#include "sim/exploration/reach.hpp"

#include <optional>
#include <utility>

#include "sim/exploration/grid_planner.hpp"

namespace nbvopt {
namespace {

/// How far beyond all that is known and the goal a way around may lead.
constexpr double kDetour_m = 10.0;

/// The way from the robot to the goal.
std::optional<Path> way_to(const PlaneRobot& robot, const DriveCosts& costs,
                           const Eigen::Vector2d& goal_map_m) {
  const OccupancyGrid& grid = robot.grid();
  Eigen::AlignedBox2i box = grid.bounds();
  box.extend(grid.cell_at(goal_map_m));
  const Cell detour = Cell::Constant(static_cast<int>(kDetour_m / grid.cell_m()));
  return GridPlanner(costs, robot.position_map_m(), {box.min() - detour, box.max() + detour})
      .path(goal_map_m);
}

}  // namespace

Arrival reach(PlaneRobot& robot, const DriveCosts& costs, const Eigen::Vector2d& goal_map_m,
              double until_s, const std::function<void()>& on_scan) {
  bool needs_way = true;
  while (robot.time_s() < until_s && !robot.is_out_of_time()) {
    if (needs_way || robot.is_path_blocked(costs)) {
      std::optional<Path> path = way_to(robot, costs, goal_map_m);
      if (!path) return Arrival::barred;
      robot.follow(std::move(*path));
      needs_way = false;
    }
    if (robot.has_arrived()) return Arrival::arrived;
    robot.drive_to_next_scan();
    on_scan();
  }
  return Arrival::late;
}

}  // namespace nbvopt
