#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/shared_map.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "nbvopt/solver/search.hpp"
#include "plot/query_plot.hpp"
#include "python/arguments.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"
#include "python/picture.hpp"

namespace nbvopt::python {
namespace {

using Stage = std::optional<std::string>;

std::int64_t evaluations_from(const std::optional<std::int64_t>& max_evaluations) {
  if (!max_evaluations) return StopRule{}.max_evaluations;
  if (*max_evaluations >= 1) return *max_evaluations;
  throw InputError("max_evaluations is " + std::to_string(*max_evaluations) +
                   ", it must be 1 or more");
}

std::optional<StopRule::Clock::time_point> deadline_from(
    const std::optional<double>& time_limit_ms) {
  if (!time_limit_ms) return {};
  constexpr double kLongestMs = 1e9;  // eleven days
  if (!(*time_limit_ms > 0.0 && *time_limit_ms <= kLongestMs)) {
    throw InputError("time_limit_ms is " + format_number(*time_limit_ms) +
                     ", it must be greater than 0 and at most " + format_number(kLongestMs));
  }
  return StopRule::within(*time_limit_ms).deadline;
}

BaseTwist twist_from(const py::object& base_twist) {
  const Eigen::Vector3d twist = vector3_from(base_twist, "base_twist");
  return {twist[0], twist[1], twist[2]};
}

/// A planner with the map that it plans on, for Python to ask after.
class MapPlanner {
 public:
  MapPlanner(std::shared_ptr<SharedMap> map, const Robot& robot, const std::string& evaluator)
      : map_(std::move(map)), planner_(map_, robot, evaluator) {}

  const std::shared_ptr<SharedMap>& map() const { return map_; }
  const ViewPlanner& planner() const { return planner_; }
  ViewPlanner& planner() { return planner_; }

 private:
  std::shared_ptr<SharedMap> map_;  ///< with the planner and with Python
  ViewPlanner planner_;
};

PlanResult plan(const MapPlanner& self, const py::object& base, const py::object& joints,
                double motion_time_s, const Stage& solver, const Stage& global_solver,
                const Stage& local_solver, const Stage& polish_solver, double step_pan_rad,
                double step_tilt_rad, double step_height_m, const py::object& base_twist,
                const std::vector<std::pair<double, py::object>>& base_path,
                const std::optional<double>& min_gain,
                const std::optional<std::int64_t>& max_evaluations,
                const std::optional<double>& time_limit_ms, std::int64_t seed, bool trace,
                const std::optional<double>& certify) {
  PlanRequest request;
  request.stop.deadline = deadline_from(time_limit_ms);
  request.stop.max_evaluations = evaluations_from(max_evaluations);
  request.T_map_base = base_from(base);
  request.base_twist = twist_from(base_twist);
  for (const auto& [time_s, pose] : base_path) {
    request.base_path.push_back({.time_s = time_s, .T_map_base = base_from(pose)});
  }
  request.joints = joint_position_from(joints);
  request.motion_time_s = motion_time_s;
  request.min_gain = min_gain;
  request.seed = seed_from(seed);
  request.record_trace = trace;
  if (certify) {
    request.certify = {.gap = *certify};
    if (time_limit_ms) request.certify->time_limit_ms = *time_limit_ms;
  }
  const Search search{.solver = solver,
                      .stages = named_stages(global_solver, local_solver, polish_solver),
                      .grid_steps = {non_negative(step_pan_rad, "step_pan_rad"),
                                     non_negative(step_tilt_rad, "step_tilt_rad"),
                                     non_negative(step_height_m, "step_height_m")}};
  const py::gil_scoped_release release;
  return self.planner().plan(request, search);
}

py::dict evaluate(const MapPlanner& self, const py::object& poses) {
  const std::vector<Transform> poses_T_map_sensor = poses_from(poses);
  std::vector<ViewGain> all;
  {
    const py::gil_scoped_release release;
    const Lattice& lattice = self.map()->map().lattice();
    for (std::size_t i = 0; i < poses_T_map_sensor.size(); ++i) {
      if (!lattice.contains(poses_T_map_sensor[i].translation())) {
        throw InputError("poses[" + std::to_string(i) +
                         "]: the camera is off the map's lattice of 65536 voxels an axis");
      }
    }
    all = self.planner().evaluate(poses_T_map_sensor);
  }
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

InsertResult insert(MapPlanner& self, const py::object& points, const py::object& T_map_sensor,
                    const py::object& no_returns, const py::object& colours) {
  const Scan scan = scan_from(points, no_returns, colours);
  const Transform T = pose_from(T_map_sensor, "T_map_sensor");
  const py::gil_scoped_release release;
  return self.planner().insert(scan, T);
}

std::string picture(const MapPlanner& self, const PlanResult& look, double step_pan_rad) {
  const Landscape landscape = self.planner().landscape(look);
  return plot_png({self.planner(), look, landscape, candidate_pans(look.box, step_pan_rad)});
}

py::object plot(const MapPlanner& self, const PlanResult& look,
                const std::optional<std::filesystem::path>& path, double step_pan_rad) {
  non_negative(step_pan_rad, "step_pan_rad");
  return png_or_file(path, [&] { return picture(self, look, step_pan_rad); });
}

py::array_t<double> landscape_gain(const Landscape& landscape) {
  py::array_t<double> array = make_array({static_cast<py::ssize_t>(landscape.tilt_rad.size()),
                                          static_cast<py::ssize_t>(landscape.pan_rad.size())});
  std::ranges::copy(landscape.gain, array.mutable_data());
  return array;
}

py::array_t<double> column(const std::vector<double>& values) {
  return array_of<double>(values, [](double value) { return value; });
}

void bind_landscape(py::module_& module) {
  py::class_<Landscape>(module, "Landscape",
                        "The gain over P pans and T tilts in reach, at one height.")
      .def_readonly("height_m", &Landscape::height_m)
      .def_property_readonly(
          "pan_rad", [](const Landscape& landscape) { return column(landscape.pan_rad); },
          "(P,), ascending.")
      .def_property_readonly(
          "tilt_rad", [](const Landscape& landscape) { return column(landscape.tilt_rad); },
          "(T,), ascending.")
      .def_property_readonly("gain", &landscape_gain, "(T, P): a row a tilt.");
}

}  // namespace

void bind_planner(py::module_& module) {
  bind_landscape(module);
  py::class_<MapPlanner>(
      module, "Planner",
      "Where should the camera look next? Plans views of a map for one robot, judged by one "
      "evaluator. A plan sees every scan that was inserted before it began.")
      .def(py::init<std::shared_ptr<SharedMap>, const Robot&, const std::string&>(), py::arg("map"),
           py::arg_v("robot", Robot{}, "Robot()"), py::arg("evaluator") = "exact",
           "evaluator: \"exact\" visits every voxel that a ray pierces, \"paper-code\" is the "
           "paper's released code. ValueError: it is not known.")
      .def_property_readonly("map", &MapPlanner::map)
      .def_property_readonly(
          "robot", [](const MapPlanner& self) { return self.planner().robot(); },
          "With the camera as the evaluator describes it.")
      .def_property_readonly("evaluator",
                             [](const MapPlanner& self) { return self.planner().evaluator(); })
      .def("plan", &plan, py::arg("base"), py::arg("joints"), py::arg("motion_time_s"),
           py::kw_only(), py::arg("solver") = py::none(), py::arg("global_solver") = py::none(),
           py::arg("local_solver") = py::none(), py::arg("polish_solver") = py::none(),
           py::arg("step_pan_rad") = 0.8, py::arg("step_tilt_rad") = 0.0,
           py::arg("step_height_m") = 0.0, py::arg("base_twist") = py::make_tuple(0.0, 0.0, 0.0),
           py::arg("base_path") = py::tuple(), py::arg("min_gain") = py::none(),
           py::arg("max_evaluations") = py::none(), py::arg("time_limit_ms") = py::none(),
           py::arg("seed") = 1, py::arg("trace") = false, py::arg("certify") = py::none(),
           "A PlanResult: that of `nbvopt query`, to the last bit.\n\n"
           "base: (x, y, yaw) or (x, y, z, yaw). joints: where they are now, (pan, tilt, height).\n"
           "motion_time_s: how long the joints may move; 0 means no limit.\n"
           "solver: the name of a search; \"auto\" when neither it nor a stage is named.\n"
           "global_solver, local_solver, polish_solver: compose a search of other stages than\n"
           "auto's; \"none\" leaves one out.\n"
           "step_...: of the solver \"grid\"; 0 keeps the joint where it is.\n"
           "base_twist: the base's velocity in its own frame (m/s, m/s, rad/s), which it keeps.\n"
           "base_path: where the base will be, (seconds from now, base) each, instead of a twist:\n"
           "the view is taken from where the path leads when the motion time is over.\n"
           "min_gain: with less to be had the answer is to stay, and says no_gain_in_reach. None: "
           "1, or\n"
           "0 where the robot's gain is neither positive nor expected.\n"
           "max_evaluations, time_limit_ms: limits of computing; the answer is then the best so\n"
           "far.\n"
           "seed: of solvers that draw random numbers.\n"
           "trace: whether the answer lists every evaluation.\n"
           "certify: asks for a bound on what any view in reach gains, and this gap is enough:\n"
           "0.01, say. Without time_limit_ms it takes 10 s at most.\n\n"
           "ValueError: an argument of a wrong shape, not finite or out of range, joints beyond\n"
           "their limits, a solver that is not known or cannot do this.")
      .def("evaluate", &evaluate, py::arg("poses"),
           "What the views from `poses`, (N, 4, 4) T_map_sensor, are worth: a dict of (N,) arrays. "
           "gain (Eq. 13) and its parts unknown_gain and occupied_gain; unknown_rays, "
           "occupied_rays and free_rays, how many rays ended so. Joint limits do not bind. "
           "ValueError: a wrong shape, a pose that is not rigid or not finite, or off the map's "
           "lattice.")
      .def(
          "landscape",
          [](const MapPlanner& self, const PlanResult& look) {
            return self.planner().landscape(look);
          },
          py::arg("look"), py::call_guard<py::gil_scoped_release>(),
          "The Landscape around an answer of this planner: a view every 0.05 rad over the pans and "
          "tilts in reach at its height, or as dense as 20,000 views allow.")
      .def("plot", &plot, py::arg("look"), py::arg("path") = py::none(),
           py::arg("step_pan_rad") = 0.8,
           "The picture of an answer of this planner: the map around it, the views, and the gain "
           "that others would have had. It has the search's way where the plan was made with "
           "trace=True, and is then that of `nbvopt query --plot`. Returns the bytes of a PNG "
           "file or, where a path is given, writes them there, whole or not at all.\n\n"
           "step_pan_rad: between the pans of the paper's grid; 0 leaves them out. ValueError: it "
           "is negative, or the file cannot be written.")
      .def("insert", &insert, py::arg("points"), py::arg("T_map_sensor"), py::kw_only(),
           py::arg("no_returns") = py::none(), py::arg("colours") = py::none(),
           "Inserts a scan of this robot's camera into the map, as Map.insert() does.");
}

}  // namespace nbvopt::python
