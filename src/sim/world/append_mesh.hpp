// Putting meshes together.
#pragma once

#include <Eigen/Geometry>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

/// Appends the triangles of a mesh, given in frame `part`, to one in frame `whole`. A transform
/// that mirrors turns their order, so that outsides stay outside. Left behind are triangles that no
/// ray can meet, being without area or not finite, and vertices that no triangle uses.
void append_mesh(const TriangleMesh& mesh_part, const Eigen::Affine3d& T_whole_part,
                 TriangleMesh& mesh_whole);

/// A mesh stretched along its axes, as append_mesh() puts it.
TriangleMesh scaled(const TriangleMesh& mesh, const Eigen::Vector3d& factors);

}  // namespace nbvopt
