// Worlds from files: Gazebo worlds with their models, and single meshes.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/sim/people.hpp"
#include "nbvopt/sim/triangle_mesh.hpp"

namespace nbvopt {

enum class WorldGeometry { visual, collision };

/// How a world is read.
struct WorldOptions {
  /// Folders that hold models by name, searched in this order, after the world's own, the folder of
  /// the file. Each stands also for `models` in it and beside it, and for the folder above.
  std::vector<std::filesystem::path> model_paths = {};
  WorldGeometry geometry = WorldGeometry::visual;
  bool is_strict = false;    ///< refuse a world that would load with parts missing
  double mesh_unit_m = 1.0;  ///< of a single mesh's coordinates, m; worlds of Gazebo are in metres
  /// Where built worlds are kept; none: nowhere. A kept world is read again as long as every file
  /// that it was built from is unchanged.
  std::optional<std::filesystem::path> cache_folder = {};
};

/// A world in the map frame.
struct World {
  TriangleMesh mesh;
  Eigen::AlignedBox3d bounds_m;  ///< of everything but planes
  std::uint64_t models = 0;      ///< top-level ones; 0 for a single mesh
  std::uint64_t nested_models = 0;
  People people;                      ///< who are not in the mesh
  std::vector<std::string> warnings;  ///< one line each: what is missing, faulty or left out
  std::vector<std::string> missing;   ///< those of them that keep a part out of the world
};

/// Reads a Gazebo world (.world, .sdf) or a single mesh (PLY, OBJ, STL, COLLADA, OFF, glTF).
/// Coordinates of a single mesh are in the given unit (COLLADA's in its own, times that), z up, of
/// glTF y up. Throws InputError that names the file: missing or not readable, not a world, without
/// any geometry, a Gazebo world with another unit than the metre; when strict, the first part that
/// is missing. Nothing is fetched from a network.
World read_world(const std::filesystem::path& path, const WorldOptions& options);

/// The folders where Gazebo itself looks for models, as far as they are there: those of
/// GAZEBO_MODEL_PATH, GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH and GAZEBO_RESOURCE_PATH, and
/// ~/.gazebo/models.
std::vector<std::filesystem::path> gazebo_model_paths();

/// Where the user's programs keep what they can make again (XDG Base Directory Specification);
/// none where the environment names no place.
std::optional<std::filesystem::path> user_cache_folder();

}  // namespace nbvopt
