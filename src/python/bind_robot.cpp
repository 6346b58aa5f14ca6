#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "mast/urdf_names.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/planner/robot.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"

namespace nbvopt::python {

namespace {

py::array_t<double> sensor_poses(const Robot& robot, const py::object& base,
                                 const py::object& joints) {
  PlanRequest request;
  request.T_map_base = base_from(base);
  const Mast mast(robot.mast);
  std::vector<Transform> poses;
  for (const JointPosition& q : joint_positions_from(joints)) {
    poses.push_back(T_map_sensor(request, mast, q));
  }
  return to_array(poses);
}

Robot robot_of(const std::optional<std::filesystem::path>& path, const std::string& camera_link,
               const std::string& base_link, const std::optional<std::string>& camera_axes) {
  UrdfOptions urdf{.camera_link = camera_link, .base_link = base_link};
  if (camera_axes) {
    urdf.camera_axes = enum_value<CameraAxes>(*camera_axes);
    if (!urdf.camera_axes) {
      throw InputError("camera_axes is '" + *camera_axes + "', it must be optical or body");
    }
  }
  if (path) return read_robot(*path, {}, urdf);
  if (urdf != UrdfOptions{}) throw InputError("links are of a URDF: give its path, too");
  return {};
}

}  // namespace

void bind_robot(py::module_& module) {
  py::class_<Robot>(module, "Robot",
                    "The camera and its mast. The default is the paper's platform; a YAML file "
                    "with the blocks `sensor` and `mast` replaces what it names, a URDF the mast.")
      .def(py::init(&robot_of), py::arg("path") = py::none(), py::kw_only(),
           py::arg("camera_link") = "", py::arg("base_link") = "",
           py::arg("camera_axes") = py::none(),
           "Of a URDF, `camera_link` names the optical centre's link, `base_link` the base's (else "
           "its root), and `camera_axes` says whether the former's are 'optical' or 'body' (else "
           "optical if its name says so). ValueError: the file is missing, or something in it "
           "cannot be used.")
      .def_static(
          "parse", [](const std::string& yaml_text) { return parse_robot(yaml_text, "yaml_text"); },
          py::arg("yaml_text"), "The same from the text of such a file.")
      .def("to_yaml", &to_yaml, "The whole robot as such a file, a comment a field.")
      .def_property_readonly(
          "half_fov_rad",
          [](const Robot& robot) {
            return py::make_tuple(robot.sensor.half_fov_horizontal_rad,
                                  robot.sensor.half_fov_vertical_rad);
          },
          "Half the field of view: (horizontal, vertical).")
      .def_property_readonly(
          "range_m",
          [](const Robot& robot) {
            return py::make_tuple(robot.sensor.range_min_m, robot.sensor.range_max_m);
          },
          "Where the camera measures: (D_min, D_max).")
      .def(
          "__eq__", [](const Robot& robot, const Robot& other) { return robot == other; },
          py::is_operator())
      .def("__repr__", [](const Robot& robot) {
        return robot == Robot{} ? "Robot()" : "Robot.parse('''" + to_yaml(robot) + "''')";
      });
  module.def(
      "sensor_poses", &sensor_poses, py::arg("robot"), py::arg("base"), py::arg("joints"),
      "(N, 4, 4) T_map_sensor of a robot whose base stands at `base`, (x, y, yaw) or (x, y, "
      "z, yaw), with its joints at `joints`, (N, 3): pan, tilt, height. Limits do not bind.");
}

}  // namespace nbvopt::python
