#include "sim/world/sdf_geometry.hpp"

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "nbvopt/core/error.hpp"
#include "sim/world/append_mesh.hpp"
#include "sim/world/primitives.hpp"
#include "sim/world/sdf_pose.hpp"

namespace nbvopt {

namespace {

/// The name of a shape's element, empty when the geometry has none.
std::string shape_name(const sdf::Geometry& geometry) {
  const sdf::ElementPtr element = geometry.Element();
  const sdf::ElementPtr shape = element ? element->GetFirstElement() : nullptr;
  return shape && shape->GetName() != "empty" ? shape->GetName() : std::string();
}

}  // namespace

TriangleMesh SdfGeometryReader::mesh_of(const sdf::Geometry& geometry, const std::string& model) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return box_mesh(vector_of(geometry.BoxShape()->Size()));
    case sdf::GeometryType::SPHERE:
      return ellipsoid_mesh(Eigen::Vector3d::Constant(geometry.SphereShape()->Radius()));
    case sdf::GeometryType::ELLIPSOID:
      return ellipsoid_mesh(vector_of(geometry.EllipsoidShape()->Radii()));
    case sdf::GeometryType::CYLINDER:
      return cylinder_mesh(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length());
    case sdf::GeometryType::CAPSULE:
      return capsule_mesh(geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length());
    case sdf::GeometryType::PLANE: {
      const sdf::Plane& plane = *geometry.PlaneShape();
      return plane_mesh(vector_of(plane.Normal()), {plane.Size().X(), plane.Size().Y()});
    }
    case sdf::GeometryType::MESH:
      return mesh_from_file(*geometry.MeshShape(), model);
    case sdf::GeometryType::HEIGHTMAP:
    case sdf::GeometryType::EMPTY:
      if (const std::string shape = shape_name(geometry); !shape.empty()) {
        log_.left_out("model '" + model + "': a shape of type '" + shape +
                      "' is left out, use a mesh instead");
      }
  }
  return {};
}

std::optional<std::filesystem::path> SdfGeometryReader::find(const std::string& uri,
                                                             const std::string& naming_file) const {
  // The world's own text has no file name for libsdformat, or one in brackets.
  const bool is_world = naming_file.empty() || naming_file.starts_with('<');
  return model_paths_.find(
      uri, is_world ? world_folder_ : std::filesystem::path(naming_file).parent_path());
}

TriangleMesh SdfGeometryReader::mesh_from_file(const sdf::Mesh& shape, const std::string& model) {
  const auto file = find(shape.Uri(), shape.FilePath());
  if (!file) {
    log_.not_found("model '" + model + "': mesh '" + shape.Uri() +
                   "' is not found, give the folder of its model as a model path");
    return {};
  }
  TriangleMesh scaled;
  append_mesh(file_mesh({*file, {shape.Submesh(), shape.CenterSubmesh()}}, model),
              Eigen::Affine3d(Eigen::Scaling(vector_of(shape.Scale()))), scaled);
  return scaled;
}

const TriangleMesh& SdfGeometryReader::file_mesh(const MeshKey& key, const std::string& model) {
  const auto [found, is_new] = meshes_.try_emplace(key);
  if (!is_new) return found->second;
  log_.read(key.first);
  try {
    found->second = read_mesh_file(key.first, key.second);
  } catch (const InputError& error) {
    log_.left_out("model '" + model + "': mesh is left out: " + error.what());
  }
  return found->second;
}

}  // namespace nbvopt
