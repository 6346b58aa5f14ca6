// Where a base may drive in the plane, and how gladly.
#pragma once

#include <Eigen/Core>

#include "nbvopt/sim/occupancy_grid.hpp"
#include "sim/exploration/clearance_field.hpp"

namespace nbvopt {

/// What a way costs, in metres: its length where there is room, more along walls.
class DriveCosts {
 public:
  struct Rules {
    double clearance_min_m;        ///< nearer to an occupied cell than this none passes
    double clearance_preferred_m;  ///< nearer than this a way costs more than its length
    bool through_unknown;          ///< whether unknown cells may be passed
  };

  /// The grid and the field must outlive this, and may change.
  DriveCosts(const OccupancyGrid& grid, const ClearanceField& field, const Rules& rules)
      : grid_(grid), field_(field), rules_(rules) {}

  const OccupancyGrid& grid() const { return grid_; }

  bool is_passable(const Cell& cell) const;

  /// Whether a base may go from one cell to its neighbour: the neighbour is passable, or the base
  /// stands too near to something, as when a scan has just shown it, and moves away from it.
  bool can_step(const Cell& from, const Cell& to) const;

  /// What a metre in this cell costs, at least 1.
  double weight(const Cell& cell) const;

  /// What the straight line costs, +inf where it cannot be driven.
  double line_cost_m(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& to_map_m) const;

 private:
  bool is_open(const Cell& cell) const;

  const OccupancyGrid& grid_;
  const ClearanceField& field_;
  Rules rules_;
};

}  // namespace nbvopt
