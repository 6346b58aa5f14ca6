#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "plot/episode_plot.hpp"
#include "python/picture.hpp"
#include "python/sim_bindings.hpp"

namespace nbvopt::python {
namespace {

py::array_t<double> trajectory(const Drive& drive) {
  const std::vector<TrajectoryPoint>& points = drive.trajectory.points();
  py::array_t<double> array = make_array({static_cast<py::ssize_t>(points.size()), 5});
  double* next = array.mutable_data();
  for (const TrajectoryPoint& point : points) {
    for (const double value : {point.time_s, point.x_m, point.y_m, point.z_m, point.yaw_rad}) {
      *next++ = value;
    }
  }
  return array;
}

void bind_drive(py::module_& module) {
  py::class_<Drive, std::shared_ptr<Drive>>(module, "Drive", "Where a base was when.")
      .def(py::init([](const std::filesystem::path& path) { return Drive{read_trajectory(path)}; }),
           py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Reads a CSV file that save() or `nbvopt simulate --trajectory-out` wrote. ValueError: "
           "it is missing or damaged.")
      .def(
          "save",
          [](const Drive& drive, const std::filesystem::path& path) {
            write_trajectory(drive.trajectory, path);
          },
          py::arg("path"), py::call_guard<py::gil_scoped_release>(),
          "Writes such a file. ValueError: it cannot be written.")
      .def_property_readonly("trajectory", &trajectory,
                             "(N, 5): time (s), x, y, z (m) and yaw (rad, not wrapped) in the map.")
      .def_property_readonly(
          "status",
          [](const Drive& drive) -> std::optional<std::string> {
            if (!drive.status) return {};
            return to_string(*drive.status);
          },
          "\"complete\", \"time_limit\", or None where it was read from a file.")
      .def_property_readonly("duration_s",
                             [](const Drive& drive) { return drive.trajectory.duration_s(); })
      .def_property_readonly(
          "length_m", [](const Drive& drive) { return drive.trajectory.length_m(); },
          "Of the way in the plane.");
}

/// A column an entry of the objects, which are alike; numbers that do not exist are NaN.
py::dict columns(const std::vector<Json>& objects) {
  py::dict result;
  if (objects.empty()) return result;
  for (const auto& [key, first] : objects.front().items()) {
    const auto column = [&, name = key]<class Value>(const Value& none) {
      return array_of<Value>(objects, [&](const Json& object) {
        const Json& value = object.at(name);
        return value.is_null() ? none : value.get<Value>();
      });
    };
    const py::str name(key);
    if (first.is_boolean()) {
      result[name] = column(false);
    } else if (first.is_number_integer()) {
      result[name] = column(std::int64_t{0});
    } else if (first.is_array()) {
      py::array_t<double> rows = make_array(
          {static_cast<py::ssize_t>(objects.size()), static_cast<py::ssize_t>(first.size())});
      double* next = rows.mutable_data();
      for (const Json& object : objects) {
        for (const Json& value : object.at(key)) *next++ = value.get<double>();
      }
      result[name] = rows;
    } else {
      result[name] = column(Capture::kNaN);
    }
  }
  return result;
}

py::dict capture_columns(const Episode& episode) {
  std::vector<Json> objects;
  for (const Capture& capture : episode.captures) objects.push_back(to_json(capture));
  return columns(objects);
}

py::object plot(const Episode& episode, const std::optional<std::filesystem::path>& path) {
  return png_or_file(path, [&] {
    const auto held = episode.map->hold();
    return episode_plot_png({episode.map->map(), episode.robot, episode.captures, episode.report});
  });
}

}  // namespace

void bind_episode(py::module_& module) {
  bind_drive(module);
  py::class_<Episode>(module, "Episode",
                      "A drive along which the camera captured, the map grew, and the next view "
                      "was planned: the paper's experiment.")
      .def_property_readonly("captures", &capture_columns,
                             "A dict of arrays, an entry a capture: the keys and numbers of "
                             "`nbvopt simulate --metrics`; base and true_base are (N, 4): x, y, "
                             "z, yaw. NaN is what that leaves null.")
      .def_property_readonly(
          "summary",
          [](const Episode& episode) {
            return py::module_::import("json").attr("loads")(to_json(episode.report).dump());
          },
          "A dict: what `nbvopt simulate --json` prints.")
      .def_readonly("map", &Episode::map, "The Map that it made.")
      .def_readonly("drive", &Episode::drive, "The Drive that it followed.")
      .def("plot", &plot, py::arg("path") = py::none(),
           "The picture of the episode, as `nbvopt simulate --plot` makes it. Returns the bytes of "
           "a PNG file or, where a path is given, writes them there, whole or not at all. "
           "ValueError: the file cannot be written.");
}

}  // namespace nbvopt::python
