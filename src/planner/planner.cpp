#include "nbvopt/planner/planner.hpp"

#include <algorithm>
#include <cmath>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "planner/panorama_objective.hpp"
#include "planner/plan_message.hpp"
#include "planner/search_trace.hpp"
#include "planner/view_objective.hpp"

namespace nbvopt {
namespace {

void check(const PlanRequest& request) {
  if (!request.T_map_base.matrix().allFinite()) {
    throw InputError("base: every number of its pose must be finite");
  }
  if (!std::isfinite(request.motion_time_s) || request.motion_time_s < 0.0) {
    throw InputError("motion_time_s is " + format_number(request.motion_time_s) +
                     " s, it must be 0 (no limit) or more");
  }
  const BaseTwist& twist = request.base_twist;
  if (!Eigen::Vector3d(twist.vx_m_s, twist.vy_m_s, twist.wz_rad_s).allFinite()) {
    throw InputError("base_twist: every velocity must be finite");
  }
}

PlanStatus plan_status(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return PlanStatus::optimal_within_tolerance;
    case SolveStatus::grid_complete:
      return PlanStatus::grid_complete;
    case SolveStatus::evaluation_limit:
    case SolveStatus::stalled:  // gave up: more evaluations would have brought nothing
      return PlanStatus::evaluation_limit;
    case SolveStatus::time_limit:
      return PlanStatus::time_limit;
    case SolveStatus::cancelled:
      return PlanStatus::cancelled;
    case SolveStatus::not_run:
      break;
  }
  return PlanStatus::not_run;
}

/// The faces of the box that a point lies on, to rounding; a frozen joint has none to speak of.
std::vector<std::string> active_bounds(const JointBox& box, const Eigen::Vector3d& q) {
  constexpr double kRounding = 1e-9;  // of the box's width
  std::vector<std::string> names;
  for (const Joint joint : kJoints) {
    const auto i = static_cast<Eigen::Index>(joint);
    if (box.min[i] == box.max[i]) continue;
    const double slack = kRounding * (box.max[i] - box.min[i]);
    if (q[i] - box.min[i] <= slack) names.push_back(to_string(joint) + "_min");
    if (box.max[i] - q[i] <= slack) names.push_back(to_string(joint) + "_max");
  }
  return names;
}

/// A slip of the unit lies beyond these.
void check_drive(double drive_m, double turn_rad) {
  constexpr double kLongestDrive_m = 100.0;
  constexpr double kLongestTurn_rad = 100.0;
  const auto check = [](double value, double most, const std::string& verb, const char* unit) {
    if (value <= most) return;
    throw InputError("base_twist: the base would " + verb + " " + format_number(std::round(value)) +
                     unit + " while the joints move, at most " + format_number(most) + unit +
                     " can be predicted");
  };
  check(drive_m, kLongestDrive_m, "drive", " m");
  check(turn_rad, kLongestTurn_rad, "turn", " rad");
}

/// Whether the request's own limits ended the search, and not the solver's.
bool was_cut_short(SolveStatus status, const StopRule& stop) {
  return status == SolveStatus::time_limit || status == SolveStatus::cancelled ||
         (status == SolveStatus::evaluation_limit &&
          stop.max_evaluations != StopRule{}.max_evaluations);
}

}  // namespace

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

Planner::Planner(const Robot& robot, std::shared_ptr<const VoxelGrid> grid,
                 std::shared_ptr<const ViewEvaluator> evaluator)
    : mast_(robot.mast),
      sensor_(robot.sensor),
      grid_(std::move(grid)),
      evaluator_(std::move(evaluator)) {}

PlanResult Planner::plan(const PlanRequest& asked, const Solver& solver) const {
  const auto begin = StopRule::Clock::now();
  check(asked);
  PlanResult result;
  PlanRequest request = asked;
  request.joints = mast_.clamped(asked.joints, result.warnings);
  const MovingMast mast = moving_mast(request, mast_);
  const KeyBox reachable = reachable_voxels(request);
  grid_->make_ready(reachable);
  warn_of_map(reachable, state_at_camera(mast, request.joints), result.warnings);
  result.box = search_box(request);

  const auto trace = request.record_trace ? std::make_unique<SearchTrace>(begin) : nullptr;
  const PanoramaObjective surrogate(grid_, sensor_, mast, result.box,
                                    request.surrogate.value_or(planning_panorama(sensor_.counting)),
                                    trace.get());
  const ViewObjective objective(mast, sensor_, result.box, *evaluator_, &surrogate, trace.get());
  const SolveResult solved =
      solver.solve(objective, {request.joints.vector(), request.stop, request.seed});
  result.current = objective.view(request.joints.vector());
  choose(request, mast, objective, solved, result);

  result.evaluations = objective.evaluations();
  result.surrogate_evaluations = solved.surrogate_evaluations;
  if (trace) result.trace = trace->points();
  result.solver = solver.name();
  result.seed = request.seed;
  result.map_version = grid_->version();
  result.search_time_ms =
      std::chrono::duration<double, std::milli>(StopRule::Clock::now() - begin).count();
  return result;
}

void Planner::choose(const PlanRequest& request, const MovingMast& mast,
                     const ViewObjective& objective, const SolveResult& solved,
                     PlanResult& result) const {
  const auto take = [&](const JointPosition& q) {
    result.joints = q;
    result.view = objective.view(q.vector());
    result.move_time_s = mast.arrival_time_s(q);
    result.T_map_base = mast.T_map_base(result.move_time_s);
    result.T_map_sensor = mast.T_map_sensor(q);
    result.active_bounds = active_bounds(result.box, q.vector());
  };
  take(JointPosition::from(solved.best));
  result.status = plan_status(solved.status);
  if (!was_cut_short(solved.status, request.stop) && result.view.gain < request.min_gain) {
    result.status = PlanStatus::no_gain_in_reach;
    result.message = no_gain_message(state_at_camera(mast, request.joints), result.view);
    take(request.joints);
  } else {
    result.message = gain_message(result);
  }
}

VoxelState Planner::state_at_camera(const MovingMast& mast, const JointPosition& joints) const {
  return grid_->state(grid_->lattice().key(mast.T_map_sensor(joints).translation()));
}

void Planner::warn_of_map(const KeyBox& reachable, VoxelState at_camera,
                          std::vector<std::string>& warnings) const {
  if (!grid_->has_occupied()) warnings.emplace_back("the map has no occupied voxel");
  if (!grid_->any_known(reachable)) {
    warnings.emplace_back("nothing in reach of the camera is mapped: the base is outside the map");
  } else if (at_camera == VoxelState::unknown) {
    warnings.emplace_back(
        "the camera stands in unmapped space: is the base where you think it is?");
  }
  if (grid_->has_occupied() && !grid_->carries_uncertainty()) {
    warnings.emplace_back("the map carries no uncertainty: every occupied voxel counts with u = " +
                          format_number(sensor_.occupied_uncertainty));
  }
}

JointBox Planner::search_box(const PlanRequest& request) const {
  const MovingMast mast = moving_mast(request, mast_);
  const JointPosition& joints = request.joints;
  JointBox box = mast_.reachable_box(joints, request.motion_time_s);
  const auto column_is_occupied = [&](double height_m) {
    JointPosition q = joints;
    q.height_m = height_m;
    return state_at_camera(mast, q) == VoxelState::occupied;
  };
  // Half voxels along the way of the optical centre, as far as it moves through no obstacle. One
  // that starts inside an obstacle may leave it. A moving base lengthens the way.
  const double way_per_height =
      1.0 + request.base_twist.speed_m_s() / mast_.options().height_velocity_m_s;
  const double step_m = 0.5 * grid_->lattice().resolution_m() / way_per_height;
  const auto reach = [&](double limit_m, double direction) {
    bool inside = column_is_occupied(joints.height_m);
    double free_m = joints.height_m;
    for (int i = 1; direction * (limit_m - free_m) > 0.0; ++i) {
      const double next_m = joints.height_m + direction * i * step_m;
      const double height_m = direction * (limit_m - next_m) > 0.0 ? next_m : limit_m;
      if (column_is_occupied(height_m)) {
        if (!inside) return free_m;
      } else {
        inside = false;
      }
      free_m = height_m;
    }
    return limit_m;
  };
  box.max[2] = reach(box.max[2], 1.0);
  box.min[2] = reach(box.min[2], -1.0);
  return box;
}

KeyBox Planner::reachable_voxels(const PlanRequest& request) const {
  const MovingMast mast = moving_mast(request, mast_);
  const JointBox box = mast_.reachable_box(request.joints, request.motion_time_s);
  const double longest_s = mast.longest_arrival_time_s(box);
  const double drive_m = request.base_twist.speed_m_s() * longest_s;
  check_drive(drive_m, std::abs(request.base_twist.wz_rad_s) * longest_s);

  // The drive in pieces: no point of a piece is farther from its middle than half its length.
  constexpr double kPiece_m = 0.5;
  const int pieces = std::max(1, static_cast<int>(std::ceil(drive_m / kPiece_m)));
  const double radius_m = mast_.options().sensor_offset_m.norm() + sensor_.longest_range_m() +
                          grid_->lattice().resolution_m() + 0.5 * drive_m / pieces;
  Eigen::AlignedBox3d mast_tops;
  for (int piece = 0; piece < pieces; ++piece) {
    const Transform T_map_base = mast.T_map_base(longest_s * (piece + 0.5) / pieces);
    for (const double height_m : {box.min[2], box.max[2]}) {
      mast_tops.extend(T_map_base * Eigen::Vector3d(0.0, 0.0, height_m));
    }
  }
  return {grid_->lattice().key(mast_tops.min() - Eigen::Vector3d::Constant(radius_m)),
          grid_->lattice().key(mast_tops.max() + Eigen::Vector3d::Constant(radius_m))};
}

}  // namespace nbvopt
