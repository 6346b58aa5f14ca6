// Terrain from pictures.
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

/// The terrain that a picture (PNG, 8 or 16 bits; the first channel counts) shows, as Gazebo makes
/// it: centred about z, its top row at +y, size.x by size.y wide; black lies at z = 0, the
/// brightest pixel at size.z. A negative size.z puts black at the top. A picture of more than 1025
/// pixels a side is sampled down. Throws InputError that names the file: missing, not readable as
/// PNG, too small or too large.
TriangleMesh heightmap_mesh(const std::filesystem::path& file, const Eigen::Vector3d& size_m);

}  // namespace nbvopt
