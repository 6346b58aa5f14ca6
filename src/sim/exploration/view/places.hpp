// Where a base could go next.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/grid_planner.hpp"

namespace nbvopt {

/// Stands for all that lies in a square of the plane.
struct Place {
  Cell square;  ///< of a lattice of squares, which keep their names while the map grows
  Eigen::Vector2d position_map_m;
};

/// Row by row.
struct SquareOrder {
  bool operator()(const Cell& a, const Cell& b) const {
    return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
  }
};

/// The square that a position lies in.
Cell square_at(const Eigen::Vector2d& position_map_m);

/// A place a square: of the cells to which the planner finds a way, in the region and off open
/// ground, the one nearest to the square's middle. In SquareOrder.
std::vector<Place> reachable_places(const DriveCosts& costs, GridPlanner& planner,
                                    const DriveRegion& region);

}  // namespace nbvopt
