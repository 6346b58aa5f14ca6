// The normals of the surfaces that a scan has met.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// The unit normals at the points of a scan, towards the camera, all in the sensor frame: of the
/// plane through a point's neighbours in a depth image of `width` x `height` pixels with the
/// sensor's field of view, in whatever order the points come. Zero where a point is alone, or its
/// neighbours lie on other surfaces.
std::vector<Eigen::Vector3f> scan_normals(std::span<const Eigen::Vector3f> points_m,
                                          const SensorOptions& sensor, int width, int height);

/// The unit normal of the face by which a ray enters a voxel on its way to a point in it, in
/// lattice coordinates, towards the ray's origin; zero for an origin in the voxel.
Eigen::Vector3d entered_face_normal(const Eigen::Vector3d& origin, const Eigen::Vector3d& point,
                                    VoxelKey voxel);

}  // namespace nbvopt
