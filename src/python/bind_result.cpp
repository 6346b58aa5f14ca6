#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/number.hpp"
#include "nbvopt/planner/plan.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"

namespace nbvopt::python {
namespace {

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

}  // namespace

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
      .def_property_readonly(
          "upper_bound",
          [](const PlanResult& result) {
            return result.certificate ? std::optional(result.certificate->upper_bound)
                                      : std::nullopt;
          },
          "No view in reach gains more. None where certify was not asked for.")
      .def_property_readonly(
          "gap",
          [](const PlanResult& result) {
            return result.certificate ? std::optional(result.certificate->gap()) : std::nullopt;
          },
          "What a better view could add at most, as a share of upper_bound.")
      .def_readonly("solver", &PlanResult::solver)
      .def_readonly("seed", &PlanResult::seed)
      .def_readonly("warnings", &PlanResult::warnings)
      .def_property_readonly("trace", &trace_arrays,
                             "Every evaluation of the search in order, where it was asked for: a "
                             "dict of the arrays kind (\"exact\" or \"surrogate\"), joints (N, 3), "
                             "gain, best_gain and time_ms.")
      .def("__repr__", &to_text);
}

}  // namespace nbvopt::python
