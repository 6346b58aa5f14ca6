#include "study/unit_runner.hpp"

#include <chrono>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "experiment/digest.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "sensor/sensor_names.hpp"
#include "study/reference_search.hpp"
#include "study/spec/start_sampling.hpp"

namespace nbvopt::study {
namespace {

constexpr const char* kExact = "exact";

double elapsed_ms(StopRule::Clock::time_point since) {
  return std::chrono::duration<double, std::milli>(StopRule::Clock::now() - since).count();
}

Json joints_json(const JointPosition& q) { return {q.pan_rad, q.tilt_rad, q.height_m}; }

PlanRequest request_of(const WorkUnit& unit) {
  PlanRequest request = request_of(unit.start);
  request.motion_time_s = unit.motion_time_s;
  request.min_gain = 0.0;  // a search is to be judged by what it finds, however little
  request.seed = unit.seed;
  request.record_trace = true;
  if (unit.budget.max_evaluations > 0) request.stop.max_evaluations = unit.budget.max_evaluations;
  return request;
}

/// The gain once the request's joints have arrived at these.
double gain_at(const ViewPlanner& planner, const PlanRequest& request, const JointPosition& q) {
  return planner.evaluate(T_map_sensor(request, planner.mast(), q)).gain;
}

/// The steps of the best exact gain. What was searched on another evaluator is judged again.
Json progress_json(const std::vector<TracePoint>& trace, const ViewPlanner& exact,
                   const PlanRequest& request, bool is_exact, std::vector<double>& times_ms) {
  std::vector<std::size_t> evaluations;
  std::vector<std::size_t> exact_evaluations;
  std::vector<double> gains;
  std::size_t exact_count = 0;
  double best = -1.0;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const TracePoint& point = trace[i];
    if (point.kind != EvaluationKind::exact) continue;
    ++exact_count;
    if (!(point.gain > best)) continue;
    best = point.gain;
    const double gain = is_exact ? point.gain : gain_at(exact, request, point.joints);
    if (!gains.empty() && gain <= gains.back()) continue;
    evaluations.push_back(i + 1);
    exact_evaluations.push_back(exact_count);
    gains.push_back(gain);
    times_ms.push_back(point.time_ms);
  }
  return {{"evaluations", evaluations}, {"exact_evaluations", exact_evaluations}, {"gain", gains}};
}

}  // namespace

/// A map and a robot, ready to be asked.
class UnitRunner::Scene {
 public:
  explicit Scene(const WorkUnit& unit)
      : map_file_(unit.map),
        robot_file_(unit.robot),
        map_digest_(experiment::file_digest(unit.map)),
        robot_(read_robot(unit.robot)),
        map_(std::make_shared<SharedMap>(read_map(unit.map))) {}

  bool is_of(const WorkUnit& unit) const {
    return unit.map == map_file_ && unit.map_digest == map_digest_ && unit.robot == robot_file_;
  }
  void check_digest(const WorkUnit& unit) const {
    if (unit.map_digest == map_digest_) return;
    throw InputError(unit.map.string() + " has changed since the study began");
  }

  const ViewPlanner& planner(UncertaintyMode mode, const StudySearch& search) {
    Robot robot = robot_;
    robot.sensor.uncertainty_mode = mode;
    if (search.gain) robot.sensor.gain = *search.gain;
    return planner(robot, search.evaluator);
  }
  /// Judges by the robot's exact gain, as this mode counts it.
  const ViewPlanner& exact(UncertaintyMode mode) { return planner(mode, {.evaluator = kExact}); }
  /// The same with a ray for each pixel.
  const ViewPlanner& dense(UncertaintyMode mode) {
    Robot robot = robot_;
    robot.sensor.uncertainty_mode = mode;
    robot.sensor.horizontal_rays = robot.sensor.horizontal_pixels;
    robot.sensor.vertical_rays = robot.sensor.vertical_pixels;
    return planner(robot, kExact);
  }
  Counting counting() const { return robot_.sensor.counting; }

 private:
  const ViewPlanner& planner(const Robot& robot, const std::string& evaluator) {
    const SensorOptions& sensor = robot.sensor;
    const auto key = std::tuple(sensor.uncertainty_mode, evaluator, to_string(sensor.gain),
                                sensor.horizontal_rays);
    const auto known = planners_.find(key);
    if (known != planners_.end()) return known->second;
    return planners_.emplace(key, ViewPlanner(map_, robot, evaluator)).first->second;
  }

  std::filesystem::path map_file_;
  std::filesystem::path robot_file_;
  std::string map_digest_;
  Robot robot_;
  std::shared_ptr<SharedMap> map_;  ///< of all planners
  std::map<std::tuple<UncertaintyMode, std::string, std::string, int>, ViewPlanner> planners_;
};

UnitRunner::UnitRunner(SolverFactory make) : make_(std::move(make)) {}
UnitRunner::~UnitRunner() = default;

Json UnitRunner::run(const WorkUnit& unit) {
  if (!scene_ || !scene_->is_of(unit)) {
    scene_.reset();  // first: two big maps need not fit into memory
    scene_ = std::make_unique<Scene>(unit);
  }
  scene_->check_digest(unit);
  return unit.kind == WorkKind::query ? run_query(unit) : run_reference(unit);
}

Json UnitRunner::run_query(const WorkUnit& unit) {
  const bool is_exact = unit.search.evaluator == kExact && !unit.search.gain;
  const auto solver = make_(unit.search.search);
  const ViewPlanner& planner = scene_->planner(unit.mode, unit.search);
  PlanRequest request = request_of(unit);
  request.surrogate = surrogate_options(unit.search, scene_->counting());
  // Whoever is first at a place would pay for its bricks otherwise.
  planner.make_ready(request);
  if (unit.budget.time_limit_ms > 0.0) {
    request.stop.deadline = StopRule::within(unit.budget.time_limit_ms).deadline;
  }
  const PlanResult result = planner.plan(request, *solver);

  const ViewPlanner& exact = scene_->exact(unit.mode);
  std::vector<double> progress_ms;
  const Json progress = progress_json(result.trace, exact, request, is_exact, progress_ms);
  Json gain_by_mode = Json::object();
  for (const auto& [mode, name] : kEnumNames<UncertaintyMode>) {
    gain_by_mode[std::string(name)] = scene_->exact(mode).evaluate(result.T_map_sensor).gain;
  }
  return {
      {"status", to_string(result.status)},
      {"joints", joints_json(result.joints)},
      {"gain", is_exact ? result.view.gain : gain_at(exact, request, result.joints)},
      {"current_gain", is_exact ? result.current.gain : gain_at(exact, request, request.joints)},
      {"gain_by_mode", gain_by_mode},
      {"dense_gain", scene_->dense(unit.mode).evaluate(result.T_map_sensor).gain},
      {"evaluations", result.evaluations},
      {"surrogate_evaluations", result.surrogate_evaluations},
      {"move_time_s", result.move_time_s},
      {"progress", progress},
      {"times", {{"search_ms", result.search_time_ms}, {"progress_ms", progress_ms}}}};
}

Json UnitRunner::run_reference(const WorkUnit& unit) {
  const auto begin = StopRule::Clock::now();
  const ViewPlanner& planner = scene_->exact(unit.mode);
  const PlanRequest request = request_of(unit);
  const MovingMast mast = moving_mast(request, planner.mast());
  const auto gain = [&](const JointPosition& q) {
    return planner.evaluate(mast.T_map_sensor(q)).gain;
  };
  const Reference reference = find_reference(gain, planner.reachable_box(request));
  Json levels = Json::array();
  for (const ReferenceLevel& level : reference.levels) {
    levels.push_back({{"steps", {level.steps[0], level.steps[1], level.steps[2]}},
                      {"evaluations", level.evaluations},
                      {"gain", level.gain}});
  }
  JointPosition best = reference.joints;
  Json record{{"gain", reference.gain},
              {"evaluations", reference.evaluations},
              {"agreed", reference.has_agreed},
              {"levels", levels}};
  const SensorOptions& sensor = planner.robot().sensor;
  if (sensor.gain.is_of_paper()) {
    // About as much work again goes into the proof: a cone costs what some rays do.
    constexpr std::int64_t kRaysPerCone = 8;
    PlanRequest proof = request;
    proof.certify = {.gap = 0.0,
                     .time_limit_ms = 1e9,
                     .max_cones = reference.evaluations * sensor.horizontal_rays *
                                  sensor.vertical_rays / kRaysPerCone};
    const CertifiedView certified = planner.certify(proof, reference.joints);
    best = certified.joints;
    record["gain"] = certified.certificate.gain;
    record["upper_bound"] = certified.certificate.upper_bound;
    record["gap"] = certified.certificate.gap();
  }
  record["joints"] = joints_json(best);
  record["dense_gain"] = gain_at(scene_->dense(unit.mode), request, best);
  record["times"] = {{"search_ms", elapsed_ms(begin)}};
  return record;
}

}  // namespace nbvopt::study
