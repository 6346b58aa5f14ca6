#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"

namespace nbvopt::python {
namespace {

/// An evaluator with the map that it looks at.
class MapEvaluator {
 public:
  MapEvaluator(std::shared_ptr<SharedMap> map, const Robot& robot, const std::string& name)
      : planner_(std::move(map), robot, name) {}

  /// The gains of the views in their order; other Python threads run meanwhile.
  std::vector<ViewGain> evaluate(const py::object& poses) const {
    const std::vector<Transform> poses_T_map_sensor = poses_from(poses);
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i < poses_T_map_sensor.size(); ++i) {
      if (!planner_.grid()->lattice().contains(poses_T_map_sensor[i].translation())) {
        throw InputError("poses[" + std::to_string(i) +
                         "]: the camera is off the map's lattice of 65536 voxels an axis");
      }
    }
    return planner_.evaluate(poses_T_map_sensor);
  }

 private:
  ViewPlanner planner_;
};

py::array_t<double> gains(const MapEvaluator& evaluator, const py::object& poses) {
  return array_of<double>(evaluator.evaluate(poses),
                          [](const ViewGain& view) { return view.gain; });
}

py::dict views(const MapEvaluator& evaluator, const py::object& poses) {
  const std::vector<ViewGain> all = evaluator.evaluate(poses);
  py::dict result;
  const auto add = [&]<class Value>(const char* name, Value ViewGain::*field) {
    result[name] = array_of<Value>(all, [field](const ViewGain& view) { return view.*field; });
  };
  add("gain", &ViewGain::gain);
  add("unknown_gain", &ViewGain::unknown_gain);
  add("occupied_gain", &ViewGain::occupied_gain);
  add("unknown_rays", &ViewGain::unknown_rays);
  add("occupied_rays", &ViewGain::occupied_rays);
  add("free_rays", &ViewGain::free_rays);
  return result;
}

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

void bind_views(py::module_& module) {
  py::class_<MapEvaluator>(
      module, "Evaluator",
      "What views of a map are worth: \"exact\" visits every voxel that a ray pierces, "
      "\"paper-code\" is the paper's released code.")
      .def(py::init<std::shared_ptr<SharedMap>, const Robot&, const std::string&>(), py::arg("map"),
           py::arg_v("robot", Robot{}, "Robot()"), py::arg("evaluator") = "exact",
           "ValueError: the evaluator is not known.")
      .def("gains", &gains, py::arg("poses"),
           "(N,) gains (Eq. 13) of the views from `poses`, (N, 4, 4) T_map_sensor. Joint limits do "
           "not bind. ValueError: a wrong shape, a pose that is not rigid or not finite, or off "
           "the map's lattice.")
      .def("views", &views, py::arg("poses"),
           "The same views in full, a dict of (N,) arrays: gain and its parts unknown_gain and "
           "occupied_gain; unknown_rays, occupied_rays and free_rays, how many rays ended so.");
  module.def(
      "sensor_poses", &sensor_poses, py::arg("robot"), py::arg("base"), py::arg("joints"),
      "(N, 4, 4) T_map_sensor of a robot whose base stands at `base`, (x, y, yaw) or (x, y, "
      "z, yaw), with its joints at `joints`, (N, 3): pan, tilt, height. Limits do not bind.");
}

}  // namespace nbvopt::python
