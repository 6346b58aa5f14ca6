#include "sim/exploration/goal_assignment.hpp"

#include <algorithm>
#include <limits>

#include "sim/exploration/cell_walk.hpp"

namespace nbvopt {
namespace {

// The names and values are those of Umari and Mukhopadhyay's published assigner.
constexpr double kInformationMultiplier_m_per_square_m =
    3.0;  ///< metres of way that 1 m^2 is worth
constexpr double kHysteresisRadius_m = 3.0;
constexpr double kHysteresisGain = 2.0;

constexpr double kApproach_m = 0.5;

bool is_in_sight(const OccupancyGrid& grid, const Eigen::Vector2d& from_map_m,
                 const Eigen::Vector2d& to_map_m) {
  bool is_clear = true;
  walk_cells(from_map_m / grid.cell_m(), to_map_m / grid.cell_m(), [&](const Cell& cell) {
    is_clear = grid.state(cell) != CellState::occupied;
    return is_clear;
  });
  return is_clear;
}

/// What a frontier is worth before the way to it is paid for.
double worth_m(const Frontier& frontier, double distance_m) {
  const double gain = distance_m <= kHysteresisRadius_m ? kHysteresisGain : 1.0;
  return kInformationMultiplier_m_per_square_m * gain * frontier.unknown_m2;
}

}  // namespace

std::optional<Cell> approach_cell(const DriveCosts& costs, const Eigen::Vector2d& frontier_map_m) {
  const OccupancyGrid& grid = costs.grid();
  const Cell centre = grid.cell_at(frontier_map_m);
  const int reach = static_cast<int>(kApproach_m / grid.cell_m());
  std::optional<Cell> nearest;
  double nearest_m = kApproach_m;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Cell cell = centre + Cell(x, y);
      const Eigen::Vector2d position_map_m = grid.centre_map_m(cell);
      const double distance_m = (position_map_m - frontier_map_m).norm();
      if (distance_m < nearest_m && costs.is_passable(cell) &&
          is_in_sight(grid, position_map_m, frontier_map_m)) {
        nearest = cell;
        nearest_m = distance_m;
      }
    }
  }
  return nearest;
}

Assignment assign_goal(const DriveCosts& costs, std::span<const Frontier> frontiers,
                       const Eigen::Vector2d& robot_map_m) {
  // No way is shorter than the straight line: in the order of what is left after that, the search
  // ends as soon as no frontier to come can be better.
  struct Candidate {
    Eigen::Vector2d frontier_map_m;
    double worth_m;
    double revenue_bound_m;
  };
  std::vector<Candidate> candidates;
  for (const Frontier& frontier : frontiers) {
    const double distance_m = (frontier.position_map_m - robot_map_m).norm();
    const double worth = worth_m(frontier, distance_m);
    candidates.push_back({frontier.position_map_m, worth, worth - distance_m + kApproach_m});
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::revenue_bound_m);

  Assignment assignment;
  GridPlanner planner(costs, robot_map_m, costs.grid().bounds());
  double best_m = -std::numeric_limits<double>::infinity();
  const Candidate* best = nullptr;
  Cell best_cell;
  for (const Candidate& candidate : candidates) {
    if (candidate.revenue_bound_m <= best_m) break;
    const std::optional<Cell> cell = approach_cell(costs, candidate.frontier_map_m);
    const std::optional<double> cost_m = cell ? planner.cost_m(*cell) : std::nullopt;
    if (!cost_m) {
      assignment.unreachable_map_m.push_back(candidate.frontier_map_m);
    } else if (const double revenue_m = candidate.worth_m - *cost_m; revenue_m > best_m) {
      best_m = revenue_m;
      best = &candidate;
      best_cell = *cell;
    }
  }
  if (best) {
    assignment.goal =
        Goal{best->frontier_map_m, *planner.path(costs.grid().centre_map_m(best_cell))};
  }
  return assignment;
}

}  // namespace nbvopt
