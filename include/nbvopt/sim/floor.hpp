// Where a base stands.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// The height of the first surface below a point; none where there is no surface.
std::optional<double> floor_height_m(const Scene& scene, const Eigen::Vector3d& above_map_m);

}  // namespace nbvopt
