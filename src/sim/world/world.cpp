#include "nbvopt/sim/world.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/input_file.hpp"
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
  constexpr std::array kMeshExtensions{".ply", ".obj", ".stl", ".dae"};
  if (std::ranges::count(kSdfExtensions, extension) > 0) return FileKind::sdf;
  if (std::ranges::count(kMeshExtensions, extension) > 0) return FileKind::mesh;
  throw InputError(path.string() +
                   ": is neither a world (.world, .sdf) nor a mesh (.ply, .obj, .stl, .dae)");
}

SdfWorld read_parts(const fs::path& path, const WorldOptions& options, WorldLog& log) {
  log.read(path);
  if (kind_of(path) == FileKind::sdf) {
    return read_sdf_world(read_text_file(path), path, options, log);
  }
  SdfWorld world;
  world.parts.push_back({.model = path.stem().string(), .mesh = read_mesh_file(path, {})});
  return world;
}

/// Puts the parts together.
World assemble(const SdfWorld& from) {
  World world;
  world.models = from.models;
  world.nested_models = from.nested_models;
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
