#include "planner/planner.hpp"

#include <chrono>
#include <cmath>

#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/solver/search.hpp"
#include "planner/certify.hpp"
#include "planner/panorama_objective.hpp"
#include "planner/plan_message.hpp"
#include "planner/search_trace.hpp"
#include "planner/view_objective.hpp"

namespace nbvopt {
namespace {

void check_path(const PlanRequest& request) {
  if (!request.base_twist.is_zero()) {
    throw InputError("base_path tells where the base will be: leave base_twist out");
  }
  if (!(request.motion_time_s > 0.0)) {
    throw InputError(
        "base_path needs a motion_time_s greater than 0: when it is over, the view is taken");
  }
  double last_s = 0.0;
  for (std::size_t i = 0; i < request.base_path.size(); ++i) {
    const TimedPose& pose = request.base_path[i];
    const std::string where = "base_path[" + std::to_string(i) + ']';
    if (!pose.T_map_base.matrix().allFinite()) {
      throw InputError(where + ": every number of its pose must be finite");
    }
    if (!std::isfinite(pose.time_s) || pose.time_s < last_s || (i > 0 && pose.time_s == last_s)) {
      throw InputError(where + ".time_s is " + format_number(pose.time_s) +
                       " s, times must rise from 0 or later");
    }
    last_s = pose.time_s;
  }
}

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
  if (!request.base_path.empty()) check_path(request);
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

void check(const CertifyOptions& options, const SensorOptions& sensor,
           const std::string& evaluator) {
  if (!(options.gap >= 0.0 && options.gap < 1.0)) {
    throw InputError("certify.gap is " + format_number(options.gap) +
                     ", it must be a share from 0 to less than 1, such as 0.01");
  }
  if (!(options.time_limit_ms > 0.0 && options.time_limit_ms <= 1e9)) {
    throw InputError("certify.time_limit_ms is " + format_number(options.time_limit_ms) +
                     ", it must be greater than 0 and at most 1e9");
  }
  if (evaluator != "exact" || !sensor.gain.is_of_paper()) {
    throw UsageError(
        "only the gains positive and expected by the evaluator exact have a bound, and "
        "not " +
        to_string(sensor.gain) + " by " + evaluator);
  }
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

/// Whether the request's own limits ended the search, and not the solver's.
bool was_cut_short(SolveStatus status, const StopRule& stop) {
  return status == SolveStatus::time_limit || status == SolveStatus::cancelled ||
         (status == SolveStatus::evaluation_limit &&
          stop.max_evaluations != StopRule{}.max_evaluations);
}

/// What takes the place of a solver that searches on a surrogate, where the gain has none; null
/// where the solver will do. Only the default search is replaced, and says so.
std::unique_ptr<Solver> search_without_surrogate(const Solver& solver, const GainChoice& gain,
                                                 std::vector<std::string>& warnings) {
  constexpr const char* kDefault = "auto";
  constexpr const char* kInstead = "nlopt:direct-l";
  if (gain.is_of_paper() || !solver.needs().surrogate) return nullptr;
  const std::string none = "gain " + to_string(gain) + " has no surrogate to search on";
  if (solver.name() != kDefault) {
    throw UsageError(none + ": use solver grid, random or " + kInstead +
                     ", or gain positive or expected");
  }
  warnings.push_back(none + ": solver " + kInstead + " searches the exact gain instead");
  return make_solver(kInstead, {});
}

}  // namespace

Planner::Planner(const Robot& robot, std::shared_ptr<const VoxelGrid> grid,
                 std::shared_ptr<const ViewEvaluator> evaluator, const HazardTable& hazards)
    : mast_(robot.mast),
      sensor_(robot.sensor),
      grid_(std::move(grid)),
      evaluator_(std::move(evaluator)),
      hazards_(hazards) {}

PlanResult Planner::plan(const PlanRequest& asked, const Solver& solver) const {
  PlanResult result;
  result.request = usable(asked, result.warnings);
  const PlanRequest& request = result.request;
  const Stopwatch filling;
  const Reach reach = ready_reach(request);
  result.grid_ms = filling.elapsed_ms();

  const auto begin = StopRule::Clock::now();
  const MovingMast& mast = reach.mast;
  warn_of_map(reach.sight, state_at_camera(*grid_, mast, request.joints), result.warnings);
  result.box = box_free_of_obstacles(reach, *grid_);
  const auto trace = request.record_trace ? std::make_unique<SearchTrace>(begin) : nullptr;
  const PanoramaObjective surrogate(grid_, sensor_, mast, result.box,
                                    request.surrogate.value_or(planning_panorama(sensor_.counting)),
                                    hazards_, trace.get());
  const ViewObjective objective(mast, sensor_, result.box, *evaluator_,
                                sensor_.gain.is_of_paper() ? &surrogate : nullptr, trace.get());
  const auto exact_search = search_without_surrogate(solver, sensor_.gain, result.warnings);
  const Solver& used = exact_search ? *exact_search : solver;
  SolveResult solved = used.solve(objective, {request.joints.vector(), request.stop, request.seed});
  result.current = objective.view(request.joints.vector());
  result.search_time_ms =
      std::chrono::duration<double, std::milli>(StopRule::Clock::now() - begin).count();
  if (request.certify) {
    const CertifiedView certified =
        nbvopt::certify(*grid_, sensor_, mast, result.box, objective,
                        JointPosition::from(solved.best), *request.certify, request.stop);
    solved.best = certified.joints.vector();
    result.certificate = certified.certificate;
  }
  choose(mast, objective, solved, result);

  result.evaluations = objective.evaluations();
  result.surrogate_evaluations = solved.surrogate_evaluations;
  if (trace) result.trace = trace->points();
  result.solver = used.name();
  result.seed = request.seed;
  result.map_version = grid_->version();
  if (sensor_.gain.has(GainKind::expected)) result.hazards = hazards_;
  return result;
}

CertifiedView Planner::certify(const PlanRequest& asked, const JointPosition& joints) const {
  PlanRequest request = asked;
  if (!request.certify) request.certify.emplace();
  std::vector<std::string> warnings;  // a plan reports them
  request = usable(request, warnings);
  const Reach reach = ready_reach(request);
  const JointBox box = box_free_of_obstacles(reach, *grid_);
  const ViewObjective objective(reach.mast, sensor_, box, *evaluator_, nullptr, nullptr);
  return nbvopt::certify(*grid_, sensor_, reach.mast, box, objective, joints, *request.certify,
                         request.stop);
}

JointBox Planner::reachable_box(const PlanRequest& asked) const {
  std::vector<std::string> warnings;  // a plan reports them
  return box_free_of_obstacles(ready_reach(usable(asked, warnings)), *grid_);
}

void Planner::make_ready(const PlanRequest& asked) const {
  std::vector<std::string> warnings;  // a plan reports them
  ready_reach(usable(asked, warnings));
}

PlanRequest Planner::usable(const PlanRequest& asked, std::vector<std::string>& warnings) const {
  check(asked);
  if (asked.certify) check(*asked.certify, sensor_, evaluator_->name());
  PlanRequest request = asked;
  request.joints = mast_.clamped(asked.joints, warnings);
  return request;
}

Reach Planner::ready_reach(const PlanRequest& request) const {
  const Reach reach = reach_of(request, mast_, sensor_, grid_->lattice());
  grid_->make_ready(reach.sight);
  return reach;
}

double Planner::least_gain(const PlanRequest& request) const {
  return request.min_gain.value_or(sensor_.gain.is_of_paper() ? 1.0 : 0.0);
}

void Planner::choose(const MovingMast& mast, const ViewObjective& objective,
                     const SolveResult& solved, PlanResult& result) const {
  const PlanRequest& request = result.request;
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
  if (result.certificate && result.certificate->gap() <= request.certify->gap &&
      result.status != PlanStatus::cancelled) {
    result.status = PlanStatus::certified;
  }
  const VoxelState at_camera = state_at_camera(*grid_, mast, request.joints);
  const bool is_worth_a_move = result.view.gain >= least_gain(request);
  if (at_camera == VoxelState::occupied ||
      (!is_worth_a_move && !was_cut_short(solved.status, request.stop))) {
    result.status = PlanStatus::no_gain_in_reach;
    result.message = no_gain_message(at_camera, result.view);
    take(request.joints);
  } else {
    result.message = gain_message(result);
  }
}

void Planner::warn_of_map(const Surroundings& sight, VoxelState at_camera,
                          std::vector<std::string>& warnings) const {
  if (!grid_->has_occupied()) warnings.emplace_back("the map has no occupied voxel");
  if (!grid_->any_known(sight)) {
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

}  // namespace nbvopt
