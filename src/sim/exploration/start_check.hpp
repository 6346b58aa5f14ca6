// Whether a base can start where it is told to.
#pragma once

#include "nbvopt/core/transform.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// Throws InputError that names the start unless the base stands upright, has room around it at the
/// lidar's height, and is not inside a solid.
void require_free_start(const Scene& scene, const Transform& T_map_base,
                        const ExplorationOptions& options);

}  // namespace nbvopt
