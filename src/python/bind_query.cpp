#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "nbvopt/solver/search.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"

namespace nbvopt::python {
namespace {

using Stage = std::optional<std::string>;

double non_negative(double value, const std::string& name) {
  if (value >= 0.0) return value;
  throw InputError(name + " is " + format_number(value) + ", it must be 0 or more");
}

std::uint64_t seed_from(std::int64_t seed) {
  if (seed >= 0) return static_cast<std::uint64_t>(seed);
  throw InputError("seed is " + std::to_string(seed) + ", it must be 0 or more");
}

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

PlanResult query(const std::shared_ptr<SharedMap>& map, const Robot& robot, const py::object& base,
                 const py::object& joints, double motion_time_s, const Stage& solver,
                 const Stage& global_solver, const Stage& local_solver, const Stage& polish_solver,
                 double step_pan_rad, double step_tilt_rad, double step_height_m,
                 const std::string& evaluator, const py::object& base_twist, double min_gain,
                 const std::optional<std::int64_t>& max_evaluations,
                 const std::optional<double>& time_limit_ms, std::int64_t seed, bool trace) {
  PlanRequest request;
  request.stop.deadline = deadline_from(time_limit_ms);
  request.stop.max_evaluations = evaluations_from(max_evaluations);
  request.T_map_base = base_from(base);
  request.base_twist = twist_from(base_twist);
  request.joints = joint_position_from(joints);
  request.motion_time_s = motion_time_s;
  request.min_gain = min_gain;
  request.seed = seed_from(seed);
  request.record_trace = trace;
  const auto search =
      make_solver({.solver = solver,
                   .stages = named_stages(global_solver, local_solver, polish_solver),
                   .grid_steps = {non_negative(step_pan_rad, "step_pan_rad"),
                                  non_negative(step_tilt_rad, "step_tilt_rad"),
                                  non_negative(step_height_m, "step_height_m")}});

  const py::gil_scoped_release release;
  return ViewPlanner(map, robot, evaluator).plan(request, *search);
}

/// Every evaluation of the search, an array a field.
py::dict trace_arrays(const PlanResult& result) {
  py::list kinds;
  std::vector<Eigen::Vector3d> joints;
  for (const TracePoint& point : result.trace) {
    kinds.append(to_string(point.kind));
    joints.push_back(point.joints.vector());
  }
  const auto column = [&](double TracePoint::*field) {
    return array_of<double>(result.trace,
                            [field](const TracePoint& point) { return point.*field; });
  };
  py::dict trace;
  trace["kind"] = py::module_::import("numpy").attr("array")(kinds, py::arg("dtype") = "U9");
  trace["joints"] = to_array(joints);
  trace["gain"] = column(&TracePoint::gain);
  trace["best_gain"] = column(&TracePoint::best_gain);
  trace["time_ms"] = column(&TracePoint::time_ms);
  return trace;
}

template <class Field>
auto view_field(Field ViewGain::*field) {
  return [field](const PlanResult& result) { return result.view.*field; };
}

std::string to_text(const PlanResult& result) {
  return "<nbvopt.PlanResult pan " + format_number(result.joints.pan_rad) + " rad, tilt " +
         format_number(result.joints.tilt_rad) + " rad, height " +
         format_number(result.joints.height_m) + " m, gain " + format_number(result.view.gain) +
         ", " + to_string(result.status) + '>';
}

void bind_result(py::module_& module) {
  py::class_<PlanResult>(module, "PlanResult",
                         "The answer of a query. Its gain is exact and never less than staying.")
      .def_property_readonly(
          "joints", [](const PlanResult& result) { return to_array(result.joints); },
          "(3,): where to move pan, tilt and height.")
      .def_property_readonly("gain", view_field(&ViewGain::gain), "The gain there.")
      .def_property_readonly(
          "current_gain", [](const PlanResult& result) { return result.current.gain; },
          "The gain of staying.")
      .def_property_readonly("unknown_gain", view_field(&ViewGain::unknown_gain),
                             "The part of the gain that comes from unknown voxels.")
      .def_property_readonly("occupied_gain", view_field(&ViewGain::occupied_gain),
                             "The part that comes from badly seen ones.")
      .def_property_readonly("unknown_rays", view_field(&ViewGain::unknown_rays))
      .def_property_readonly("occupied_rays", view_field(&ViewGain::occupied_rays))
      .def_property_readonly("free_rays", view_field(&ViewGain::free_rays))
      .def_property_readonly(
          "status", [](const PlanResult& result) { return to_string(result.status); },
          "How the search ended, such as \"optimal_within_tolerance\".")
      .def_readonly("message", &PlanResult::message, "What to do, and why.")
      .def_property_readonly(
          "T_map_sensor", [](const PlanResult& result) { return to_array(result.T_map_sensor); },
          "(4, 4): the optical frame once the joints have arrived.")
      .def_property_readonly(
          "T_map_base", [](const PlanResult& result) { return to_array(result.T_map_base); },
          "(4, 4): the base once the joints have arrived.")
      .def_readonly("move_time_s", &PlanResult::move_time_s, "Of the slowest joint.")
      .def_property_readonly(
          "box", [](const PlanResult& result) { return to_array(result.box); },
          "(2, 3): the lowest and the highest joint position in reach.")
      .def_readonly("active_bounds", &PlanResult::active_bounds,
                    "Faces of the box that the answer lies on, such as \"tilt_min\".")
      .def_readonly("evaluations", &PlanResult::evaluations, "Of the evaluator.")
      .def_readonly("surrogate_evaluations", &PlanResult::surrogate_evaluations)
      .def_readonly("search_time_ms", &PlanResult::search_time_ms,
                    "Computing time of the search, without grid_ms.")
      .def_readonly("grid_ms", &PlanResult::grid_ms,
                    "Computing time of reading the voxels in reach from the map, next to nothing "
                    "where they were read before.")
      .def_readonly("solver", &PlanResult::solver)
      .def_readonly("seed", &PlanResult::seed)
      .def_readonly("warnings", &PlanResult::warnings)
      .def_property_readonly("trace", &trace_arrays,
                             "Every evaluation of the search in order, where it was asked for: a "
                             "dict of the arrays kind (\"exact\" or \"surrogate\"), joints (N, 3), "
                             "gain, best_gain and time_ms.")
      .def("__repr__", &to_text);
}

}  // namespace

void bind_query(py::module_& module) {
  bind_result(module);
  const PlanRequest defaults;
  module.def(
      "query", &query, py::arg("map"), py::arg("robot"), py::arg("base"), py::arg("joints"),
      py::arg("motion_time_s"), py::kw_only(), py::arg("solver") = py::none(),
      py::arg("global_solver") = py::none(), py::arg("local_solver") = py::none(),
      py::arg("polish_solver") = py::none(), py::arg("step_pan_rad") = 0.8,
      py::arg("step_tilt_rad") = 0.0, py::arg("step_height_m") = 0.0,
      py::arg("evaluator") = "exact", py::arg("base_twist") = py::make_tuple(0.0, 0.0, 0.0),
      py::arg("min_gain") = defaults.min_gain, py::arg("max_evaluations") = py::none(),
      py::arg("time_limit_ms") = py::none(), py::arg("seed") = 1, py::arg("trace") = false,
      "Where should the camera look next? The answer is that of `nbvopt query`, to the last "
      "bit.\n\n"
      "base: (x, y, yaw) or (x, y, z, yaw). joints: where they are now, (pan, tilt, height).\n"
      "motion_time_s: how long the joints may move; 0 means no limit.\n"
      "solver: the name of a search; \"auto\" when neither it nor a stage is named.\n"
      "global_solver, local_solver, polish_solver: compose a search of other stages than auto's;\n"
      "\"none\" leaves one out.\n"
      "step_...: of the solver \"grid\"; 0 keeps the joint where it is.\n"
      "evaluator: \"exact\" or \"paper-code\".\n"
      "base_twist: the base's velocity in its own frame (m/s, m/s, rad/s), which it keeps.\n"
      "min_gain: with less to be had the answer is to stay, and says no_gain_in_reach.\n"
      "max_evaluations, time_limit_ms: limits of computing; the answer is then the best so far.\n"
      "seed: of solvers that draw random numbers.\n"
      "trace: whether the answer lists every evaluation.\n\n"
      "ValueError: an argument of a wrong shape, not finite or out of range, joints beyond their\n"
      "limits, a solver that is not known or cannot do this.");
}

}  // namespace nbvopt::python
