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
});
template <>
inline constexpr auto kEnumNames<EvaluationKind> = std::to_array<EnumName<EvaluationKind>>({
    {EvaluationKind::exact, "exact"},
    {EvaluationKind::surrogate, "surrogate"},
});

std::string to_string(PlanStatus value) { return std::string(enum_name(value)); }

std::string to_string(EvaluationKind value) { return std::string(enum_name(value)); }

PanoramaOptions planning_panorama(Counting counting) {
  constexpr double kLayerSpacing = 6.0;
  return {.ray_spacing = counting == Counting::per_voxel ? 1.0 : 2.0,
          .layer_spacing = kLayerSpacing};
}

MovingMast moving_mast(const PlanRequest& request, const Mast& mast) {
  return {mast, request.T_map_base, request.base_twist, request.joints};
}

Transform T_map_sensor(const PlanRequest& request, const Mast& mast, const JointPosition& joints) {
  return moving_mast(request, mast).T_map_sensor(joints);
}

}  // namespace nbvopt
