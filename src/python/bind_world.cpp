#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "nbvopt/sim/world.hpp"
#include "python/arguments.hpp"
#include "python/sim_bindings.hpp"
#include "sim/world/world_names.hpp"

namespace nbvopt::python {
namespace {

WorldGeometry geometry_from(const std::string& name) {
  if (const auto geometry = enum_value<WorldGeometry>(name)) return *geometry;
  throw InputError("geometry is '" + name + "', it must be visual or collision");
}

SharedWorld read(const std::filesystem::path& path, WorldOptions options) {
  for (std::filesystem::path& folder : gazebo_model_paths()) {
    options.model_paths.push_back(std::move(folder));
  }
  SharedWorld ready;
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release release;
    const World world = read_world(path, options);
    warnings = world.warnings;
    ready.reset(new ReadyWorld{path.string(), world.bounds_m, world.people, Scene(world.mesh)});
  }
  for (const std::string& warning : warnings) {
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  }
  return ready;
}

using Cache = std::variant<bool, std::filesystem::path>;

std::optional<std::filesystem::path> cache_folder_from(const Cache& cache) {
  if (const auto* folder = std::get_if<std::filesystem::path>(&cache)) return *folder;
  return std::get<bool>(cache) ? user_cache_folder() : std::nullopt;
}

SharedWorld make_world(const std::filesystem::path& path,
                       const std::vector<std::filesystem::path>& model_paths,
                       const std::string& geometry, bool is_strict, double mesh_unit_m,
                       const Cache& cache) {
  return read(path, {.model_paths = model_paths,
                     .geometry = geometry_from(geometry),
                     .is_strict = is_strict,
                     .mesh_unit_m = mesh_unit_m,
                     .cache_folder = cache_folder_from(cache)});
}

py::tuple capture(const ReadyWorld& world, const Robot& robot, const py::object& T_map_sensor,
                  std::uint64_t frame, double range_noise_m, std::int64_t seed) {
  const Transform T = pose_from(T_map_sensor, "T_map_sensor");
  const std::uint64_t noise_seed = seed_from(seed);
  Scan scan;
  {
    const py::gil_scoped_release release;
    scan = SimulatedCamera(world.scene, robot.sensor, range_noise_m, noise_seed).capture(T, frame);
  }
  return py::make_tuple(to_array(scan.points_m), to_array(scan.no_returns));
}

}  // namespace

std::string name_of(const WorldArgument& world) {
  if (const auto* ready = std::get_if<SharedWorld>(&world)) return (*ready)->name;
  return std::get<std::filesystem::path>(world).string();
}

SharedWorld world_from(const WorldArgument& world) {
  if (const auto* ready = std::get_if<SharedWorld>(&world)) return *ready;
  return read(std::get<std::filesystem::path>(world), {.cache_folder = user_cache_folder()});
}

void bind_world(py::module_& module) {
  py::class_<ReadyWorld, std::shared_ptr<ReadyWorld>>(module, "World",
                                                      "A simulated place that never changes.")
      .def(
          py::init([](const std::filesystem::path& path,
                      const std::vector<std::filesystem::path>& model_paths,
                      const std::string& geometry, bool strict, double unit_m, const Cache& cache) {
            return std::const_pointer_cast<ReadyWorld>(
                make_world(path, model_paths, geometry, strict, unit_m, cache));
          }),
          py::arg("path"), py::kw_only(),
          py::arg("model_paths") = std::vector<std::filesystem::path>{},
          py::arg("geometry") = "visual", py::arg("strict") = false, py::arg("unit_m") = 1.0,
          py::arg("cache") = true,
          "Reads a Gazebo world (.world, .sdf) or a mesh (.ply, .obj, .stl, .dae, .off, "
          ".gltf, .glb; z up, of the last two y up). What is missing or left out is a warning of "
          "Python's.\n\n"
          "model_paths: folders of models, after the world's own and before those of "
          "Gazebo's environment.\n"
          "geometry: \"visual\" or \"collision\", which shapes of the models to take.\n"
          "strict: refuse a world with parts missing instead of warning.\n"
          "unit_m: the unit of a mesh's coordinates, m (0.001: millimetres).\n"
          "cache: the folder that keeps the built world; True: the user's, False: none.\n\n"
          "ValueError: the file is missing, no world, or without any geometry.")
      .def_property_readonly(
          "bounds_m",
          [](const ReadyWorld& world) {
            return to_array(
                std::vector<Eigen::Vector3d>{world.bounds_m.min(), world.bounds_m.max()});
          },
          "(2, 3): the lowest and the highest corner of all but planes, map frame.")
      .def("capture", &capture, py::arg("robot"), py::arg("T_map_sensor"), py::kw_only(),
           py::arg("frame") = 0, py::arg("range_noise_m") = 0.0, py::arg("seed") = 1,
           "What the robot's camera sees from T_map_sensor, (4, 4): points, (N, 3) float32, and "
           "no_returns, (M, 3) float32, in the optical frame, as Map.insert() takes them.\n\n"
           "frame, seed: of the noise, whose standard deviation is range_noise_m. ValueError: a "
           "pose that is not rigid or not finite, a negative noise.");
}

}  // namespace nbvopt::python
