#include "nbvopt/planner/plan.hpp"

#include "core/enum_names.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<PlanStatus> = std::to_array<EnumName<PlanStatus>>({
    {PlanStatus::not_run, "not_run"},
    {PlanStatus::optimal_within_tolerance, "optimal_within_tolerance"},
    {PlanStatus::grid_complete, "grid_complete"},
    {PlanStatus::evaluation_limit, "evaluation_limit"},
    {PlanStatus::time_limit, "time_limit"},
    {PlanStatus::no_gain_in_reach, "no_gain_in_reach"},
    {PlanStatus::cancelled, "cancelled"},
    {PlanStatus::certified, "certified"},
});
template <>
inline constexpr auto kEnumNames<EvaluationKind> = std::to_array<EnumName<EvaluationKind>>({
    {EvaluationKind::exact, "exact"},
    {EvaluationKind::surrogate, "surrogate"},
});

std::string to_string(PlanStatus value) { return std::string(enum_name(value)); }

std::string to_string(EvaluationKind value) { return std::string(enum_name(value)); }

PanoramaOptions planning_panorama(Counting counting) {
  return {.ray_spacing = counting == Counting::per_voxel ? 1.0 : 2.0};
}

Transform T_map_base_on_path(const PlanRequest& request) {
  TimedPose last{0.0, request.T_map_base};
  for (const TimedPose& next : request.base_path) {
    if (next.time_s >= request.motion_time_s) {
      const double span_s = next.time_s - last.time_s;
      const double part = span_s > 0.0 ? (request.motion_time_s - last.time_s) / span_s : 1.0;
      Transform between;
      between.linear() = Eigen::Quaterniond(last.T_map_base.linear())
                             .slerp(part, Eigen::Quaterniond(next.T_map_base.linear()))
                             .toRotationMatrix();
      between.translation() =
          (1.0 - part) * last.T_map_base.translation() + part * next.T_map_base.translation();
      return part == 1.0 ? next.T_map_base : between;
    }
    last = next;
  }
  return last.T_map_base;
}

MovingMast moving_mast(const PlanRequest& request, const Mast& mast) {
  return {mast, T_map_base_on_path(request), request.base_twist, request.joints};
}

Transform T_map_sensor(const PlanRequest& request, const Mast& mast, const JointPosition& joints) {
  return moving_mast(request, mast).T_map_sensor(joints);
}

}  // namespace nbvopt
