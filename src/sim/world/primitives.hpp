// The simple shapes of SDF as triangles, each about its own origin.
#pragma once

#include <Eigen/Core>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

TriangleMesh box_mesh(const Eigen::Vector3d& size_m);

/// Round shapes have 64 sides, inscribed: a radius of 1 m is met within 1.3 mm.
TriangleMesh ellipsoid_mesh(const Eigen::Vector3d& radii_m);
TriangleMesh cylinder_mesh(double radius_m, double length_m);  ///< along z
TriangleMesh cone_mesh(double radius_m, double length_m);      ///< along z, its tip up
TriangleMesh capsule_mesh(double radius_m, double length_m);   ///< along z; of its straight part

/// A rectangle of two triangles, facing along the normal.
TriangleMesh plane_mesh(const Eigen::Vector3d& normal, const Eigen::Vector2d& size_m);

}  // namespace nbvopt
