// Casts rays that start from one point at an Embree scene.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <span>
#include <string>

namespace nbvopt {

/// A device that keeps what goes wrong first in a text, which must outlive it. Throws Error where
/// Embree does not run.
RTCDevice new_embree_device(std::string& first_error);

/// Shortens the distance along each ray, +inf at first or what another scene had, to the scene's
/// first surface that is nearer, and nearer than the range. Directions have unit length; neighbours
/// in order should be neighbours in direction. Casts on all cores; answers do not depend on how
/// many.
void shorten_to_hits(RTCScene scene, const Eigen::Vector3d& origin_map_m,
                     std::span<const Eigen::Vector3f> directions_map, float range_max_m,
                     std::span<float> distances_m);

}  // namespace nbvopt
