// Which frontier to go to next.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "sim/exploration/drive_costs.hpp"
#include "sim/exploration/frontier_filter.hpp"
#include "sim/exploration/grid_planner.hpp"

namespace nbvopt {

/// The passable cell nearest to a frontier, within a base's length and in sight of it: a frontier
/// in a corner is seen from where there is room. None where there is no such cell.
std::optional<Cell> approach_cell(const DriveCosts& costs, const Eigen::Vector2d& frontier_map_m);

/// A frontier and the way to it.
struct Goal {
  Eigen::Vector2d frontier_map_m;
  Path path;
};

/// What an assignment found.
struct Assignment {
  std::optional<Goal> goal;  ///< none when no frontier can be reached
  std::vector<Eigen::Vector2d> unreachable_map_m;
};

/// The frontier of the greatest revenue (Umari and Mukhopadhyay): a weight times the unknown area,
/// which counts more near the robot, minus the cost of the way.
Assignment assign_goal(const DriveCosts& costs, std::span<const Frontier> frontiers,
                       const Eigen::Vector2d& robot_map_m);

}  // namespace nbvopt
