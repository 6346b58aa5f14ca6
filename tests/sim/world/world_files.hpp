// Worlds, models and meshes that tests write, and what was read of them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <string>

#include "nbvopt/sim/triangle_mesh.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::test {

/// A folder with worlds in it and models beside them, as Gazebo's projects have.
class WorldFolder {
 public:
  WorldFolder() { std::filesystem::create_directories(folder_.path() / "worlds"); }

  /// Writes a model whose SDF element holds `body`, and gives its folder.
  std::filesystem::path add_model(const std::string& name, const std::string& body,
                                  const std::string& version = "1.6") const {
    const std::filesystem::path model = folder_.path() / "models" / name;
    write(model / "model.config",
          "<?xml version='1.0'?>\n<model><author><name>Somebody</name>"
          "</author><name>" +
              name + "</name><sdf version='" + version + "'>model.sdf</sdf></model>\n");
    write(model / "model.sdf", "<?xml version='1.0'?>\n<sdf version='" + version +
                                   "'><model name='" + name + "'>" + body + "</model></sdf>\n");
    return model;
  }

  /// Writes a world that holds `body`, and gives its path.
  std::filesystem::path add_world(const std::string& body,
                                  const std::string& version = "1.6") const {
    return add_file("worlds/test.world", "<?xml version='1.0'?>\n<sdf version='" + version +
                                             "'><world name='test'>" + body + "</world></sdf>\n");
  }

  std::filesystem::path add_file(const std::string& name, const std::string& content) const {
    return write(folder_.path() / name, content);
  }

  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  static std::filesystem::path write(const std::filesystem::path& path,
                                     const std::string& content) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }

  TemporaryFolder folder_;
};

inline std::string include(const std::string& uri, const std::string& more = "") {
  return "<include><uri>" + uri + "</uri>" + more + "</include>";
}

/// A model of one link with one visual.
inline std::string link_with(const std::string& geometry, const std::string& pose = "0 0 0 0 0 0") {
  return "<static>true</static><link name='link'><visual name='visual'><pose>" + pose +
         "</pose><geometry>" + geometry + "</geometry></visual></link>";
}

inline std::string box(const std::string& size) { return "<box><size>" + size + "</size></box>"; }

inline std::string mesh(const std::string& uri, const std::string& more = "") {
  return "<mesh><uri>" + uri + "</uri>" + more + "</mesh>";
}

/// One right-angled triangle: (0, 0, 3), (1, 0, 3), (0, 2, 3).
inline std::string triangle_stl() {
  return "solid triangle\nfacet normal 0 0 1\nouter loop\nvertex 0 0 3\nvertex 1 0 3\n"
         "vertex 0 2 3\nendloop\nendfacet\nendsolid triangle\n";
}

inline Eigen::AlignedBox3d box_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) box.extend(vertex_m.cast<double>());
  return box;
}

/// The middle of a mesh's box, rounded to a tenth of a millimetre: where a box of the test stands.
inline Eigen::Vector3d middle_of(const TriangleMesh& mesh) {
  return (box_of(mesh).center() * 1e4).array().round().matrix() * 1e-4;
}

/// Whether a mesh has a vertex here, within a hundredth of a millimetre.
inline bool has_vertex(const TriangleMesh& mesh, const Eigen::Vector3d& position_m) {
  return std::ranges::any_of(mesh.vertices_m, [&](const Eigen::Vector3f& vertex_m) {
    return (vertex_m.cast<double>() - position_m).norm() < 1e-5;
  });
}

}  // namespace nbvopt::test
