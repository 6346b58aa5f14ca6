// The shapes that libsdformat describes, as triangles.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <sdf/Geometry.hh>
#include <string>
#include <utility>

#include "nbvopt/sim/triangle_mesh.hpp"
#include "sim/world/mesh_file.hpp"
#include "sim/world/model_paths.hpp"
#include "sim/world/world_log.hpp"

namespace nbvopt {

/// Makes meshes of geometries; a mesh file is read once, however often it is used.
class SdfGeometryReader {
 public:
  /// Both must outlive the reader.
  SdfGeometryReader(const std::filesystem::path& world_folder, ModelPaths& model_paths,
                    WorldLog& log)
      : world_folder_(world_folder), model_paths_(model_paths), log_(log) {}

  /// The geometry in its own frame; empty where there is none or, with a line in the log that names
  /// the model, where it cannot be had.
  TriangleMesh mesh_of(const sdf::Geometry& geometry, const std::string& model);

  /// The file that a URI names, found from the file that it stands in (libsdformat's name for it).
  std::optional<std::filesystem::path> find(const std::string& uri,
                                            const std::string& naming_file) const;

 private:
  using MeshKey = std::pair<std::filesystem::path, Submesh>;

  TriangleMesh mesh_from_file(const sdf::Mesh& shape, const std::string& model);
  const TriangleMesh& file_mesh(const MeshKey& key, const std::string& model);

  std::filesystem::path world_folder_;
  ModelPaths& model_paths_;
  WorldLog& log_;
  std::map<MeshKey, TriangleMesh> meshes_;
};

}  // namespace nbvopt
