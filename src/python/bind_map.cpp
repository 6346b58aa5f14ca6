#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/shared_map.hpp"
#include "nbvopt/planner/robot.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"

namespace nbvopt::python {
namespace {

/// The voxels of a map at one height.
struct MapSlice {
  py::array_t<std::uint8_t> states;
  py::array_t<float> uncertainty;
  std::array<double, 4> extent_m{};  ///< as matplotlib's imshow takes it
};

/// The outer corners of a box of voxels.
JointBox corners_m(const Lattice& lattice, const KeyBox& box) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * lattice.resolution_m());
  return {lattice.centre_m(box.min) - half, lattice.centre_m(box.max) + half};
}

/// What a function says of the map, asked while no scan is inserted; other Python threads run
/// meanwhile, or one that inserts could not finish.
template <class Ask>
auto asked(const SharedMap& shared, const Ask& ask) {
  const py::gil_scoped_release release;
  const auto held = shared.hold();
  return ask(shared.map());
}

std::optional<py::array_t<double>> known_box_m(const SharedMap& shared) {
  const std::optional<KeyBox> known =
      asked(shared, [](const UncertaintyMap& map) { return map.known_box(); });
  if (!known) return {};
  return to_array(corners_m(shared.map().lattice(), *known));
}

MapSlice slice(const SharedMap& shared, double z_m) {
  const Lattice& lattice = shared.map().lattice();
  if (!std::isfinite(z_m) || !lattice.contains({0.0, 0.0, z_m})) {
    throw InputError("z_m is " + format_number(z_m) + ", it must be a height on the map's lattice");
  }
  const std::uint16_t z = lattice.key({0.0, 0.0, z_m}).z;
  std::shared_ptr<const VoxelGrid> grid;
  const std::optional<KeyBox> known = asked(shared, [&](const UncertaintyMap& map) {
    const std::optional<KeyBox> box = map.known_box();
    grid = shared.grid();
    if (box) grid->make_ready({{box->min.x, box->min.y, z}, {box->max.x, box->max.y, z}});
    return box;
  });
  if (!known) throw InputError("the map is empty: there is nothing to slice");

  const int rows = known->max.y - known->min.y + 1;
  const int columns = known->max.x - known->min.x + 1;
  MapSlice result{py::array_t<std::uint8_t>({rows, columns}), py::array_t<float>({rows, columns})};
  std::uint8_t* next_state = result.states.mutable_data();
  float* next_uncertainty = result.uncertainty.mutable_data();
  for (int y = known->min.y; y <= known->max.y; ++y) {
    for (int x = known->min.x; x <= known->max.x; ++x) {
      const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), z};
      *next_state++ = static_cast<std::uint8_t>(grid->state(key));
      *next_uncertainty++ = grid->uncertainty(key);
    }
  }
  const JointBox box = corners_m(lattice, *known);
  result.extent_m = {box.min.x(), box.max.x(), box.min.y(), box.max.y()};
  return result;
}

std::shared_ptr<SharedMap> make_map(const std::optional<std::filesystem::path>& path,
                                    const std::optional<double>& resolution_m) {
  if (path.has_value() == resolution_m.has_value()) {
    throw InputError("give the path of a map, or the resolution_m of an empty one");
  }
  return std::make_shared<SharedMap>(path ? read_map(*path) : UncertaintyMap(*resolution_m));
}

void save(const SharedMap& shared, const std::filesystem::path& path,
          const std::optional<std::string>& format) {
  const MapFormat chosen = map_format(format.value_or(""), path);
  asked(shared, [&](const UncertaintyMap& map) { write_map(map, path, chosen); });
}

void bind_insert_result(py::module_& module) {
  py::class_<InsertResult>(module, "InsertResult", "What the insertion of a scan did.")
      .def_readonly("points_used", &InsertResult::points_used, "Points within the camera's range.")
      .def_readonly("rays_cleared", &InsertResult::rays_cleared,
                    "Rays without a point in range, clear up to its end.")
      .def_readonly("points_ignored", &InsertResult::points_ignored,
                    "Points too near, not finite, or off the lattice.")
      .def_readonly("points_too_near", &InsertResult::points_too_near,
                    "Points at the camera's least range or nearer.")
      .def_readonly("points_too_far", &InsertResult::points_too_far,
                    "Points at the camera's greatest range or farther.")
      .def_readonly("no_returns", &InsertResult::no_returns,
                    "Directions in which nothing is in range.")
      .def_readonly("points_not_finite", &InsertResult::points_not_finite)
      .def_readonly("points_off_lattice", &InsertResult::points_off_lattice)
      .def_property_readonly(
          "voxels_changed", [](const InsertResult& result) { return result.changes.size(); },
          "Voxels whose state or u is another now.")
      .def_readonly("information_gained", &InsertResult::information_gained,
                    "What the map's information (Eq. 11) grew by.")
      .def_readonly("certain_voxels_gained", &InsertResult::certain_voxels_gained,
                    "What its occupied voxels with u < 1 grew by.")
      .def("__repr__", [](const InsertResult& result) {
        return "<nbvopt.InsertResult " + std::to_string(result.points_used) + " points used, " +
               std::to_string(result.rays_cleared) + " rays cleared, " +
               std::to_string(result.points_ignored) + " points ignored, " +
               std::to_string(result.changes.size()) + " voxels changed>";
      });
}

}  // namespace

void bind_map(py::module_& module) {
  py::class_<MapCounts>(module, "MapCounts",
                        "Counts over voxels at the finest resolution; information is Eq. 11.")
      .def_readonly("occupied_voxels", &MapCounts::occupied_voxels)
      .def_readonly("free_voxels", &MapCounts::free_voxels)
      .def_readonly("certain_voxels", &MapCounts::certain_voxels, "occupied with u < 1")
      .def_readonly("information", &MapCounts::information, "sum of 1 - u over occupied voxels")
      .def_readonly("leaves", &MapCounts::leaves, "of the octree")
      .def_readonly("nodes", &MapCounts::nodes, "of the octree, leaves included");

  py::class_<MapSlice>(module, "MapSlice",
                       "The voxels of a map at one height, H rows along y and W columns along x.")
      .def_readonly("states", &MapSlice::states, "(H, W) uint8: 0 unknown, 1 free, 2 occupied")
      .def_readonly("uncertainty", &MapSlice::uncertainty,
                    "(H, W) float32: u of an occupied voxel, 1 of any other")
      .def_property_readonly(
          "extent_m",
          [](const MapSlice& slice) {
            const auto& [left, right, bottom, top] = slice.extent_m;
            return py::make_tuple(left, right, bottom, top);
          },
          "(left, right, bottom, top) in the map frame: for imshow(..., origin=\"lower\")");

  bind_insert_result(module);

  py::class_<SharedMap, std::shared_ptr<SharedMap>>(
      module, "Map",
      "What is known of a place: voxels that are free, occupied or unknown, and how well occupied "
      "ones were seen.\n\n"
      "It changes by insert() only, which waits until nobody looks at the map. All planners of a "
      "map share its voxel grid, which fills as it is used.")
      .def(py::init(&make_map), py::arg("path") = py::none(), py::kw_only(),
           py::arg("resolution_m") = py::none(), py::call_guard<py::gil_scoped_release>(),
           "Reads a map: .bt, or .ot of type OcTree, ColorOcTree or UncertaintyOcTree. Without a "
           "path an empty map, its voxels resolution_m wide.\n\n"
           "ValueError: both or neither are given; the file is missing, damaged or of another "
           "kind; the resolution is not above 0 or not finite.")
      .def("save", &save, py::arg("path"), py::arg("format") = py::none(),
           "Writes the map, whole or not at all. format: \"uncertainty-ot\", all that it holds; "
           "\"bt\", free and occupied only; \"colour-ot\", for octovis, and \"ply\", points, "
           "both coloured by u; what the extension says where it is left out, .ot being "
           "\"uncertainty-ot\". ValueError: neither says one, or the file cannot be written.")
      .def(
          "insert",
          [](SharedMap& shared, const py::object& points, const py::object& T_map_sensor,
             const Robot& robot, const py::object& no_returns, const py::object& colours) {
            const Scan scan = scan_from(points, no_returns, colours);
            const Transform T = pose_from(T_map_sensor, "T_map_sensor");
            const py::gil_scoped_release release;
            return shared.insert(scan, T, robot.sensor);
          },
          py::arg("points"), py::arg("T_map_sensor"), py::arg_v("robot", Robot{}, "Robot()"),
          py::kw_only(), py::arg("no_returns") = py::none(), py::arg("colours") = py::none(),
          "Inserts a scan and returns an InsertResult: what `nbvopt map insert` does, to the last "
          "bit.\n\n"
          "points: (N, 3), in the optical frame; those that are not finite are ignored.\n"
          "T_map_sensor: (4, 4), where the optical frame is in the map.\n"
          "robot: whose camera took it, with its range and its uncertainty.\n"
          "no_returns: (M, 3) directions in the optical frame in which nothing is in range.\n"
          "colours: (N, 3) uint8, red, green and blue of each point.\n\n"
          "ValueError: a wrong shape or type, a pose that is not rigid, not finite or off the "
          "map's lattice, colours that are not one a point. The map is then as it was.")
      .def_property_readonly(
          "resolution_m", [](const SharedMap& shared) { return shared.map().resolution_m(); },
          "The width of a voxel.")
      .def_property_readonly("known_box_m", &known_box_m,
                             "(2, 3): the lowest and the highest corner of the box that holds "
                             "every known voxel, map frame; None where nothing is known.")
      .def(
          "counts",
          [](const SharedMap& shared) {
            return asked(shared, [](const UncertaintyMap& map) { return map.counts(); });
          },
          "MapCounts over voxels at the finest resolution.")
      .def("slice", &slice, py::arg("z_m"),
           "MapSlice: the voxels at a height of the map frame, over the known box. ValueError: the "
           "map is empty, or z_m off its lattice.");
}

}  // namespace nbvopt::python
