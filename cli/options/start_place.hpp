// Where a drive starts when nobody says.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/world_survey.hpp"

namespace nbvopt {

/// x, y, z and yaw of a base there, as --start takes them.
std::vector<double> pose_of(const StartPlace& place);

/// "1.5,-2,0,0".
std::string pose_text(const std::vector<double>& pose);

/// The first free place of a world. Throws InputError when there is none.
std::vector<double> first_start(const Scene& scene, const Eigen::AlignedBox3d& bounds_m,
                                const ExplorationOptions& options);

}  // namespace nbvopt
