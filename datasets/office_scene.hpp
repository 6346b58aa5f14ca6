// A small office as a known world: a corridor, two rooms with doors, windows and furniture, and
// the way of a robot that has seen a part of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// An axis-parallel box in the map frame.
struct SceneBox {
  Eigen::Vector3d min_m;
  Eigen::Vector3d max_m;
};

/// All that is solid in the office: walls, floor and ceiling first, then furniture. Boxes touch;
/// those of walls do not overlap.
std::vector<SceneBox> office_boxes();

/// The office as ground truth, 8 x 6 x 2.6 m inside its walls, floor at z = 0: every voxel of the
/// building is free or occupied, every voxel outside is unknown.
UncertaintyMap make_office(double resolution_m);

/// T_map_base wherever the robot stopped to look, in order: from the corridor's west end through
/// the door into the first room, turning on the spot at the corner.
std::vector<Transform> office_stops();

}  // namespace nbvopt
