// The shapes of SDF as triangles.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "nbvopt/sim/triangle_mesh.hpp"
#include "sim/world/mesh_file.hpp"
#include "sim/world/model_paths.hpp"
#include "sim/world/sdf_xml.hpp"
#include "sim/world/world_log.hpp"

namespace nbvopt {

/// A shape about its own origin.
struct SdfShape {
  TriangleMesh mesh;
  bool is_plane = false;
};

/// Makes meshes of <geometry>; a mesh file is read once, however often it is used.
class SdfGeometryReader {
 public:
  /// Both must outlive the reader.
  SdfGeometryReader(ModelPaths& model_paths, WorldLog& log)
      : model_paths_(model_paths), log_(log) {}

  /// The shape of a <geometry> of that file, stretched as Gazebo scales a model: round ones stay
  /// round. Empty where there is none or, with a line in the log that names the model, where it
  /// cannot be had. Throws InputError for a bad value.
  SdfShape shape_of(const SdfElement& geometry, const std::filesystem::path& file,
                    const std::string& model, const Eigen::Vector3d& scale);

 private:
  using MeshKey = std::pair<std::filesystem::path, Submesh>;

  TriangleMesh mesh_from_file(const SdfElement& mesh, const std::filesystem::path& file,
                              const std::string& model);
  TriangleMesh heightmap(const SdfElement& heightmap, const std::filesystem::path& file,
                         const std::string& model);
  const TriangleMesh& file_mesh(const MeshKey& key, const std::string& model);

  ModelPaths& model_paths_;
  WorldLog& log_;
  std::map<MeshKey, TriangleMesh> meshes_;
};

}  // namespace nbvopt
