// Mesh files, read with Assimp.
#pragma once

#include <filesystem>
#include <string>

#include "nbvopt/sim/triangle_mesh.hpp"
#include "sim/world/world_log.hpp"

namespace nbvopt {

/// Which part of a mesh file is wanted.
struct Submesh {
  std::string name;         ///< of a node or of its geometry; empty: the whole file
  bool is_centred = false;  ///< moved so that the middle of its box is the origin

  // The linter takes the zero that comparisons are compared with for a pointer.
  auto operator<=>(const Submesh&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// All triangles of a file, every instance in its place. COLLADA's unit (`meter=`) is applied, its
/// up axis is not, as in Gazebo, nor is glTF's. Lines, points and triangles without area are left
/// behind. Throws InputError that names the file: missing, not readable as a mesh, without any
/// triangle, without that submesh. `log` hears of every file that was opened: glTF keeps its
/// numbers in others.
TriangleMesh read_mesh_file(const std::filesystem::path& path, const Submesh& submesh,
                            WorldLog& log);

}  // namespace nbvopt
