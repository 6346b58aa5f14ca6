#include "sim/world/sdf_geometry.hpp"

#include <optional>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "sim/world/append_mesh.hpp"
#include "sim/world/extrusion.hpp"
#include "sim/world/heightmap.hpp"
#include "sim/world/primitives.hpp"

namespace nbvopt {

namespace {

const Eigen::Vector3d kOnes = Eigen::Vector3d::Ones();

/// The values of SDF where a shape does not say.
constexpr double kRadius_m = 0.5;
constexpr double kLength_m = 1.0;

/// Of this outline and those beside it.
TriangleMesh polyline_mesh(const SdfElement& first) {
  std::vector<std::vector<Eigen::Vector2d>> outlines_m;
  for (const SdfElement* polyline = &first; polyline != nullptr;
       polyline = polyline->NextSiblingElement("polyline")) {
    std::vector<Eigen::Vector2d>& outline_m = outlines_m.emplace_back();
    for (const SdfElement* point = polyline->FirstChildElement("point"); point != nullptr;
         point = point->NextSiblingElement("point")) {
      outline_m.push_back(point_of(*point));
    }
  }
  return extruded_mesh(outlines_m, number_of(first, "height", 1.0));
}

TriangleMesh plane_of(const SdfElement& plane) {
  const Eigen::Vector3d normal =
      vector_of(plane, "normal", Eigen::Vector3d(Eigen::Vector3d::UnitZ()));
  if (!(normal.norm() > 0.0)) throw InputError("its <normal> is zero");
  return plane_mesh(normal.normalized(),
                    vector_of(plane, "size", Eigen::Vector2d(Eigen::Vector2d::Ones())));
}

/// Shapes that need no other file; none for an element that is none.
std::optional<TriangleMesh> simple_shape(const SdfElement& shape) {
  const auto radius_m = [&](double otherwise = kRadius_m) {
    return number_of(shape, "radius", otherwise);
  };
  const auto length_m = [&] { return number_of(shape, "length", kLength_m); };
  if (is_named(shape, "box")) return box_mesh(vector_of(shape, "size", kOnes));
  if (is_named(shape, "sphere")) {
    return ellipsoid_mesh(Eigen::Vector3d::Constant(radius_m(1.0)));
  }
  if (is_named(shape, "ellipsoid")) return ellipsoid_mesh(vector_of(shape, "radii", kOnes));
  if (is_named(shape, "cylinder")) return cylinder_mesh(radius_m(1.0), length_m());
  if (is_named(shape, "capsule")) return capsule_mesh(radius_m(), length_m());
  if (is_named(shape, "cone")) return cone_mesh(radius_m(), length_m());
  if (is_named(shape, "plane")) return plane_of(shape);
  return std::nullopt;
}

/// How a saved model's scale acts on a shape: Gazebo keeps round ones round.
Eigen::Vector3d scale_of(const SdfElement& shape, const Eigen::Vector3d& scale) {
  if (is_named(shape, "sphere")) return Eigen::Vector3d::Constant(scale.maxCoeff());
  if (is_named(shape, "cylinder") || is_named(shape, "capsule") || is_named(shape, "cone")) {
    const double widest = scale.head<2>().maxCoeff();
    return {widest, widest, scale.z()};
  }
  return scale;
}

}  // namespace

SdfShape SdfGeometryReader::shape_of(const SdfElement& geometry, const std::filesystem::path& file,
                                     const std::string& model, const Eigen::Vector3d& scale) {
  const SdfElement* element = geometry.FirstChildElement();
  if (element == nullptr || is_named(*element, "empty")) return {};
  SdfShape shape{.mesh = {}, .is_plane = is_named(*element, "plane")};
  if (std::optional<TriangleMesh> simple = simple_shape(*element)) {
    shape.mesh = *std::move(simple);
  } else if (is_named(*element, "mesh")) {
    shape.mesh = mesh_from_file(*element, file, model);
  } else if (is_named(*element, "heightmap")) {
    shape.mesh = heightmap(*element, file, model);
  } else if (is_named(*element, "polyline")) {
    shape.mesh = polyline_mesh(*element);
  } else {
    log_.left_out("model '" + model + "': a shape of type '" + element->Name() +
                  "' is left out, use a mesh instead");
  }
  if (scale != kOnes) shape.mesh = scaled(shape.mesh, scale_of(*element, scale));
  return shape;
}

TriangleMesh SdfGeometryReader::mesh_from_file(const SdfElement& mesh,
                                               const std::filesystem::path& file,
                                               const std::string& model) {
  const std::string uri = text_of(mesh, "uri");
  const auto found = model_paths_.find(uri, file.parent_path());
  if (!found) {
    log_.not_found("model '" + model + "': mesh '" + uri + "' is not found, " +
                   ModelPaths::advice(uri));
    return {};
  }
  Submesh submesh;
  if (const SdfElement* part = mesh.FirstChildElement("submesh")) {
    submesh.name = text_of(*part, "name");
    const std::string centre = text_of(*part, "center");
    submesh.is_centred = centre == "true" || centre == "1";
  }
  return scaled(file_mesh({*found, submesh}, model), vector_of(mesh, "scale", kOnes));
}

TriangleMesh SdfGeometryReader::heightmap(const SdfElement& heightmap,
                                          const std::filesystem::path& file,
                                          const std::string& model) {
  const std::string uri = text_of(heightmap, "uri");
  const auto found = model_paths_.find(uri, file.parent_path());
  if (!found) {
    log_.not_found("model '" + model + "': heightmap '" + uri + "' is not found, " +
                   ModelPaths::advice(uri));
    return {};
  }
  log_.read(*found);
  const Eigen::Vector3d position_m =
      vector_of(heightmap, "pos", Eigen::Vector3d(Eigen::Vector3d::Zero()));
  TriangleMesh placed;
  append_mesh(heightmap_mesh(*found, vector_of(heightmap, "size", kOnes)),
              Eigen::Affine3d(Eigen::Translation3d(position_m)), placed);
  return placed;
}

const TriangleMesh& SdfGeometryReader::file_mesh(const MeshKey& key, const std::string& model) {
  const auto [found, is_new] = meshes_.try_emplace(key);
  if (!is_new) return found->second;
  try {
    found->second = read_mesh_file(key.first, key.second, log_);
  } catch (const InputError& error) {
    log_.left_out("model '" + model + "': mesh is left out: " + error.what());
  }
  return found->second;
}

}  // namespace nbvopt
