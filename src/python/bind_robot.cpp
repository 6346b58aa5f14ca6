#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <vector>

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

}  // namespace

void bind_robot(py::module_& module) {
  py::class_<Robot>(module, "Robot",
                    "The camera and its mast. The default is the paper's platform; a YAML file "
                    "with the blocks `sensor` and `mast` replaces what it names.")
      .def(py::init([](const std::optional<std::filesystem::path>& path) {
             return path ? read_robot(*path) : Robot{};
           }),
           py::arg("path") = py::none(),
           "ValueError: the file is missing, or a key or value in it cannot be used.")
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
