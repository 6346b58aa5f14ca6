// What a view turned out to be worth.
#pragma once

#include <span>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sensor/depth_camera.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {

/// The gain of a view by Eq. 12 and 13 with what is really there in place of the map's guess: each
/// planning ray counts for the voxel that holds the surface at `distances_m` along it (the camera's
/// rays() in their order), judged by what the map, which has not seen the view yet, knows of that
/// voxel. In the unit of the gain that planners predict.
double realised_gain(const UncertaintyMap& map, const DepthCamera& camera,
                     std::span<const float> distances_m, const Transform& T_map_sensor);

}  // namespace nbvopt
