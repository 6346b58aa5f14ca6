#include "cli/query.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "cli/ask_server.hpp"
#include "cli/map_input.hpp"
#include "cli/options/query_arguments.hpp"
#include "cli/query_answer.hpp"
#include "cli/terminal/output.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/planner/robot_fields.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "nbvopt/solver/registry.hpp"
#include "planner/search_json.hpp"
#include "plot/query_plot.hpp"

namespace nbvopt {
namespace {

Robot robot_of(const QueryOptions& options) {
  Robot robot = make_robot(options.view);
  set_counting_and_gain(robot.sensor, options.view);
  if (options.occupied_uncertainty) {
    const std::vector<FieldSetting> settings{
        {"occupied_uncertainty", *options.occupied_uncertainty}};
    set_fields(robot.sensor, settings, "--occupied-uncertainty");
  }
  return robot;
}

bool wants_landscape(const QueryOptions& options) {
  return !options.landscape_file.empty() || !options.plot_file.empty();
}

/// `lowest_m` is where the mast is when nothing is said.
PlanRequest request_of(const QueryOptions& options, double lowest_m) {
  PlanRequest request;
  request.T_map_base = options.T_map_base;
  request.base_twist = options.base_twist;
  request.joints = {options.pan_rad, options.tilt_rad, options.height_m.value_or(lowest_m)};
  request.motion_time_s = options.motion_time_s;
  request.min_gain = options.min_gain;
  request.seed = static_cast<std::uint64_t>(options.seed);
  request.stop.max_evaluations = options.max_evaluations;
  request.record_trace = !options.trace_file.empty() || wants_landscape(options);
  if (options.time_limit_ms) {
    request.stop.deadline = StopRule::within(*options.time_limit_ms).deadline;
  }
  if (options.certify) {
    request.certify.emplace();
    if (options.gap) request.certify->gap = *options.gap;
    if (options.time_limit_ms) request.certify->time_limit_ms = *options.time_limit_ms;
  }
  return request;
}

/// Writes the files that explain the answer.
void write_explanations(const QueryOptions& options, const ViewPlanner& planner,
                        const PlanResult& result) {
  if (!options.trace_file.empty()) {
    write_file_atomically(options.trace_file, to_json_lines(result.trace));
  }
  if (!wants_landscape(options)) return;
  const Landscape landscape = planner.landscape(result);
  const std::vector<double> pans_rad = candidate_pans(result.box, options.solver.step_pan_rad);
  if (!options.landscape_file.empty()) {
    write_file_atomically(options.landscape_file,
                          to_json(landscape, result, pans_rad).dump() + '\n');
  }
  if (!options.plot_file.empty()) {
    write_plot({planner, result, landscape, pans_rad}, options.plot_file);
  }
}

QueryAnswer search_map(const QueryOptions& options) {
  const Robot robot = robot_of(options);
  const auto solver = make_solver(search_of(options.solver));
  const ThreadLimit thread_limit(options.view);

  const std::optional<HazardTable> hazards = given_hazards(options.view);
  const Stopwatch loading;
  UncertaintyMap map = read_map_input({.file = options.map_file});
  QueryAnswer answer;
  answer.evaluator = options.view.evaluator;
  answer.counting = robot.sensor.counting;
  answer.map_load_ms = loading.elapsed_ms();
  // Its time limit counts from here.
  const PlanRequest request = request_of(options, robot.mast.height_min_m);
  ViewPlanner planner =
      ViewPlanner::with_given_sensor(std::move(map), robot, options.view.evaluator);
  if (hazards) planner.set_hazards(*hazards);
  answer.result = planner.plan(request, *solver);
  write_explanations(options, planner, answer.result);
  answer.result.request.joints = request.joints;  // as asked: a server's client knows no limits
  return answer;
}

void run_query(const QueryOptions& options) {
  check(options);
  const QueryAnswer answer = options.server.address.empty()
                                 ? search_map(options)
                                 : ask_server(options, request_of(options, *options.height_m));
  if (!options.json_file.empty()) {
    write_file_atomically(options.json_file, to_text(to_json(answer)));
  }
  if (options.json) {
    print_answer(to_text(to_json(answer)));
  } else {
    for (const std::string& warning : answer.result.warnings) print_message("warning: " + warning);
    print_answer(to_text(answer));
  }
}

}  // namespace

void set_up_query(CLI::App& app) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* query = app.add_subcommand("query", "Where should the camera look next?");
  add_query_arguments(*query, *options);
  std::string solvers;
  for (const std::string& name : solver_names()) solvers += (solvers.empty() ? "" : ", ") + name;
  query->footer(
      "Solvers: " + solvers +
      ".\nA joint up to 0.01 rad or 5 mm beyond its limits is moved into them, with a warning.\n"
      "Example: nbvopt query map.ot --base -1.5,2,0.3 --tilt -0.2 --motion-time 0.5");
  query->callback([options] { run_query(*options); });
}

}  // namespace nbvopt
