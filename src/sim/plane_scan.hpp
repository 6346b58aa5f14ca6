// A lidar's scan as maps in the plane take it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nbvopt/sim/simulated_lidar.hpp"
#include "sim/people/people_scene.hpp"

namespace nbvopt {

/// How far one lidar beam saw, from the base.
struct PlaneBeam {
  Eigen::Vector2d end_base_m;
  bool is_hit;  ///< a surface is at its end; otherwise it ends where it was cropped
};

/// Scans from there and crops the beams. Those that met something nearer than the lidar measures
/// are left out: where, it does not say.
std::vector<PlaneBeam> plane_scan(const SimulatedLidar& lidar, const Transform& T_world_base,
                                  double range_max_m);

/// Lets people stand in the beams' way: those that meet somebody end there without a hit, as maps
/// take them that leave out what moves.
void end_at_people(const PeopleScene& people, const SimulatedLidar& lidar,
                   const Transform& T_world_base, std::vector<PlaneBeam>& beams);

}  // namespace nbvopt
