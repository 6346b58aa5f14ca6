#include "sim/exploration/drive_costs.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "sim/exploration/cell_walk.hpp"

namespace nbvopt {
namespace {

/// What a metre at the least clearance costs beyond a metre with room.
constexpr double kWallWeight = 3.0;

}  // namespace

bool DriveCosts::is_open(const Cell& cell) const {
  const CellState state = grid_.state(cell);
  return state == CellState::free || (state == CellState::unknown && rules_.through_unknown);
}

bool DriveCosts::is_passable(const Cell& cell) const {
  return is_open(cell) && field_.clearance_m(cell) >= rules_.clearance_min_m;
}

bool DriveCosts::can_step(const Cell& from, const Cell& to) const {
  if (is_passable(to)) return true;
  return is_open(to) && !is_passable(from) && field_.clearance_m(to) > field_.clearance_m(from);
}

double DriveCosts::weight(const Cell& cell) const {
  const double missing = (rules_.clearance_preferred_m - field_.clearance_m(cell)) /
                         (rules_.clearance_preferred_m - rules_.clearance_min_m);
  const double nearness = std::clamp(missing, 0.0, 1.0);
  return 1.0 + kWallWeight * nearness * nearness;
}

double DriveCosts::line_cost_m(const Eigen::Vector2d& from_map_m,
                               const Eigen::Vector2d& to_map_m) const {
  bool is_drivable = true;
  double weights = 0.0;
  int cells = 0;
  std::optional<Cell> previous;
  walk_cells(from_map_m / grid_.cell_m(), to_map_m / grid_.cell_m(), [&](const Cell& cell) {
    is_drivable = !previous || can_step(*previous, cell);
    weights += weight(cell);
    ++cells;
    previous = cell;
    return is_drivable;
  });
  if (!is_drivable) return std::numeric_limits<double>::infinity();
  return (to_map_m - from_map_m).norm() * weights / cells;
}

}  // namespace nbvopt
