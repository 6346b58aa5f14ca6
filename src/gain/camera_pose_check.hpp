// What every evaluator asks of a camera's pose.
#pragma once

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel.hpp"

namespace nbvopt::detail {

/// Throws InputError when the pose is not finite or lies off the lattice.
inline void check_camera_pose(const Transform& T_map_sensor, const Lattice& lattice) {
  if (!T_map_sensor.matrix().allFinite()) {
    throw InputError("the camera's pose holds a number that is not finite");
  }
  if (!lattice.contains(T_map_sensor.translation())) {
    throw InputError("the camera is off the map's lattice, which spans 65536 voxels an axis");
  }
}

}  // namespace nbvopt::detail
