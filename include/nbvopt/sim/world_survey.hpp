// What a world offers to a base: floors, and places to start from.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// A level on which the base can stand.
struct FloorLevel {
  double height_m = 0.0;  ///< median
  double area_m2 = 0.0;   ///< where the base can stand, about
};

/// Where a base can start.
struct StartPlace {
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();  ///< on a floor
  double room_m = 0.0;  ///< to the nearest surface at the lidar's height
};

struct WorldSurvey {
  std::vector<FloorLevel> floors;  ///< from below
  std::vector<StartPlace>
      starts;  ///< the best first, on the main floor first; none: nowhere is room
};

/// Looks for floors and free places on a grid of about 2,500 columns over the bounds (where they
/// are empty, 10 m about the origin). A floor is a surface with a metre of air above it, at least 2
/// m2 wide and a tenth of the widest. The main floor is the lowest one with half the room between
/// walls of the roomiest: a roof has no walls. Places are free as explore() demands; best are those
/// with walls around them, then those with much room. They lie at least 2 m apart; five are given
/// of the main floor, one of each other. Throws InputError as explore() does for bad options of
/// base and lidar.
WorldSurvey survey_world(const Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                         const ExplorationOptions& options);

}  // namespace nbvopt
