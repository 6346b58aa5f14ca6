#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/shared_map.hpp"
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

std::optional<py::array_t<double>> known_box_m(const SharedMap& shared) {
  const std::optional<KeyBox> known = shared.map().known_box();
  if (!known) return {};
  return to_array(corners_m(shared.map().lattice(), *known));
}

MapSlice slice(const SharedMap& shared, double z_m) {
  const Lattice& lattice = shared.map().lattice();
  if (!std::isfinite(z_m) || !lattice.contains({0.0, 0.0, z_m})) {
    throw InputError("z_m is " + format_number(z_m) + ", it must be a height on the map's lattice");
  }
  const std::optional<KeyBox> known = shared.map().known_box();
  if (!known) throw InputError("the map is empty: there is nothing to slice");
  const std::uint16_t z = lattice.key({0.0, 0.0, z_m}).z;
  const std::shared_ptr<const VoxelGrid> shared_grid = shared.grid();
  const VoxelGrid& grid = *shared_grid;
  grid.make_ready({{known->min.x, known->min.y, z}, {known->max.x, known->max.y, z}});

  const int rows = known->max.y - known->min.y + 1;
  const int columns = known->max.x - known->min.x + 1;
  MapSlice result{py::array_t<std::uint8_t>({rows, columns}), py::array_t<float>({rows, columns})};
  std::uint8_t* next_state = result.states.mutable_data();
  float* next_uncertainty = result.uncertainty.mutable_data();
  for (int y = known->min.y; y <= known->max.y; ++y) {
    for (int x = known->min.x; x <= known->max.x; ++x) {
      const VoxelKey key{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), z};
      *next_state++ = static_cast<std::uint8_t>(grid.state(key));
      *next_uncertainty++ = grid.uncertainty(key);
    }
  }
  const JointBox box = corners_m(lattice, *known);
  result.extent_m = {box.min.x(), box.max.x(), box.min.y(), box.max.y()};
  return result;
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

  py::class_<SharedMap, std::shared_ptr<SharedMap>>(
      module, "Map",
      "A map file: .bt, or .ot of type OcTree, ColorOcTree or UncertaintyOcTree.\n\n"
      "It never changes, and all that is made of it shares one voxel grid, which fills as it is "
      "used.")
      .def(py::init([](const std::filesystem::path& path) {
             return std::make_shared<SharedMap>(read_map(path));
           }),
           py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Reads a map. ValueError: the file is missing, damaged or of another kind.")
      .def_property_readonly(
          "resolution_m", [](const SharedMap& shared) { return shared.map().resolution_m(); },
          "The width of a voxel.")
      .def_property_readonly("known_box_m", &known_box_m,
                             "(2, 3): the lowest and the highest corner of the box that holds "
                             "every known voxel, map frame; None where nothing is known.")
      .def(
          "counts", [](const SharedMap& shared) { return shared.map().counts(); },
          py::call_guard<py::gil_scoped_release>(),
          "MapCounts over voxels at the finest resolution.")
      .def("slice", &slice, py::arg("z_m"),
           "MapSlice: the voxels at a height of the map frame, over the known box. ValueError: the "
           "map is empty, or z_m off its lattice.");
}

}  // namespace nbvopt::python
