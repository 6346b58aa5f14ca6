// Outlines drawn out into solids.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

/// The solid between z = 0 and the height whose section is inside of an odd number of the closed
/// outlines (as Gazebo extrudes polylines): an outline in another is a hole. Each is closed by
/// itself, whether its last point repeats the first or not, and may cross itself. Throws InputError
/// when an outline has fewer than three points, or there are too many points or crossings.
TriangleMesh extruded_mesh(const std::vector<std::vector<Eigen::Vector2d>>& outlines_m,
                           double height_m);

}  // namespace nbvopt
