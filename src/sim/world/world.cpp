#include "nbvopt/sim/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/input_file.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/world/append_mesh.hpp"
#include "sim/world/lower_case.hpp"
#include "sim/world/mesh_file.hpp"
#include "sim/world/sdf_world.hpp"
#include "sim/world/stray_parts.hpp"
#include "sim/world/world_cache.hpp"
#include "sim/world/world_log.hpp"
#include "sim/world/world_part.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

enum class FileKind { sdf, mesh };

FileKind kind_of(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  constexpr std::array kSdfExtensions{".world", ".sdf"};
  constexpr std::array kMeshExtensions{".ply", ".obj", ".stl", ".dae", ".off", ".gltf", ".glb"};
  if (std::ranges::count(kSdfExtensions, extension) > 0) return FileKind::sdf;
  if (std::ranges::count(kMeshExtensions, extension) > 0) return FileKind::mesh;
  throw InputError(path.string() + ": is neither a world (.world, .sdf) nor a mesh " +
                   "(.ply, .obj, .stl, .dae, .off, .gltf, .glb)");
}

double longest_side_m(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex_m : mesh.vertices_m) box.extend(vertex_m);
  return box.isEmpty() ? 0.0 : static_cast<double>(box.sizes().maxCoeff());
}

/// A mesh that is a world by itself, in metres, z up. glTF's y axis points up by its specification:
/// it is turned as in Blender and RViz, but not in Gazebo's worlds, since Gazebo does not.
TriangleMesh single_mesh(const fs::path& path, const WorldOptions& options, WorldLog& log) {
  const std::string extension = lower_case(path.extension().string());
  Eigen::Affine3d T_map_file(Eigen::Scaling(options.mesh_unit_m));
  if (extension == ".gltf" || extension == ".glb") {
    T_map_file.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  }
  TriangleMesh mesh;
  append_mesh(read_mesh_file(path, {}, log), T_map_file, mesh);
  constexpr double kLong_m = 1000.0;
  if (const double length_m = longest_side_m(mesh); length_m > kLong_m) {
    log.remark(path.string() + ": the mesh is " + format_number(std::round(length_m)) +
               " m long; if its unit is not the metre, say which it is (0.001 m: millimetres)");
  }
  return mesh;
}

/// Models are metres, and say in the world how they are scaled.
void check_unit(const fs::path& path, double mesh_unit_m) {
  if (!(mesh_unit_m > 0.0) || !std::isfinite(mesh_unit_m)) {
    throw InputError("the mesh's unit is " + format_number(mesh_unit_m) +
                     " m, it must be positive and finite");
  }
  if (mesh_unit_m != 1.0 && kind_of(path) == FileKind::sdf) {
    throw InputError(path.string() +
                     ": the unit is of single meshes alone; in a Gazebo world, give a mesh its "
                     "<scale>");
  }
}

SdfWorld read_parts(const fs::path& path, const WorldOptions& options, WorldLog& log) {
  log.read(path);
  if (kind_of(path) == FileKind::sdf) {
    return read_sdf_world(read_text_file(path), path, options, log);
  }
  SdfWorld world;
  world.parts.push_back({.model = path.stem().string(), .mesh = single_mesh(path, options, log)});
  return world;
}

/// Puts the parts together.
World assemble(const SdfWorld& from) {
  World world;
  world.models = from.models;
  world.nested_models = from.nested_models;
  world.people = from.people;
  for (const WorldPart& part : from.parts) {
    append_mesh(part.mesh, Eigen::Affine3d::Identity(), world.mesh);
    if (part.is_plane) continue;
    for (const Eigen::Vector3f& vertex_m : part.mesh.vertices_m) {
      world.bounds_m.extend(vertex_m.cast<double>());
    }
  }
  return world;
}

World build_world(const fs::path& path, const WorldOptions& options, WorldLog& log) {
  SdfWorld parts = read_parts(path, options, log);
  remove_stray_parts(parts.parts, log);
  World world = assemble(parts);
  world.warnings = log.warnings();
  world.missing = log.missing();
  return world;
}

/// The world from the cache, or built and kept there. That it cannot be kept is a warning.
World cached_world(const fs::path& path, const WorldOptions& options) {
  WorldLog log;
  if (!options.cache_folder) return build_world(path, options, log);
  const WorldCache cache(*options.cache_folder, path, options);
  if (std::optional<World> kept = cache.load()) return *std::move(kept);
  World world = build_world(path, options, log);
  // A file that appears changes the world without a trace in the files that it was built from.
  if (!log.is_lasting()) return world;
  try {
    cache.store(world, log.files());
  } catch (const InputError& error) {
    world.warnings.push_back(std::string("the world is not kept: ") + error.what());
  }
  return world;
}

}  // namespace

World read_world(const fs::path& path, const WorldOptions& options) {
  open_input_file(path);
  check_unit(path, options.mesh_unit_m);
  World world = cached_world(path, options);
  if (options.is_strict && !world.missing.empty()) {
    throw InputError(path.string() + ": " + world.missing.front());
  }
  if (world.mesh.triangles.empty()) {
    throw InputError(
        path.string() + ": there is no geometry in it" +
        (world.warnings.empty() ? "" : "; the first warning: " + world.warnings.front()));
  }
  return world;
}

}  // namespace nbvopt
