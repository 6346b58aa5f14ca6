#include "cli/query.hpp"

#include <CLI/Option.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/options/arguments.hpp"
#include "cli/options/solver_arguments.hpp"
#include "cli/options/view_arguments.hpp"
#include "cli/query_answer.hpp"
#include "cli/terminal/output.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/client/planner_client.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot_fields.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "nbvopt/solver/registry.hpp"
#include "planner/search_json.hpp"
#include "plot/query_plot.hpp"

namespace nbvopt {
namespace {

constexpr std::int64_t kMaxWhole = std::numeric_limits<std::int64_t>::max();

struct QueryOptions {
  std::string map_file;  ///< empty: the server's
  std::string server;    ///< its address; empty: the map file's
  ClientTls tls;
  Transform T_map_base = Transform::Identity();
  BaseTwist base_twist;
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  std::optional<double> height_m;  ///< none: the mast's lowest
  double motion_time_s = 0.0;
  ViewArguments view;
  std::optional<double> occupied_uncertainty;  ///< none: as the robot says
  SolverArguments solver;
  double min_gain = PlanRequest{}.min_gain;
  std::int64_t seed = 1;
  std::optional<double> time_limit_ms;
  std::int64_t max_evaluations = kMaxWhole;
  bool json = false;
  std::string json_file;
  std::string plot_file;
  std::string trace_file;
  std::string landscape_file;
};

void check(const QueryOptions& options) {
  if (options.map_file.empty() == options.server.empty()) {
    throw UsageError("name a MAP, or a server that holds one by --server, and not both");
  }
  if (!options.server.empty() && !options.height_m) {
    throw UsageError("--height is needed with --server: the mast is the server's");
  }
  if (options.motion_time_s < 0.0) {
    throw InputError("--motion-time is " + format_number(options.motion_time_s) +
                     " s, it must be 0 (no limit) or more");
  }
  constexpr double kLongestMs = 1e9;  // eleven days
  if (options.time_limit_ms &&
      !(*options.time_limit_ms > 0.0 && *options.time_limit_ms <= kLongestMs)) {
    throw InputError("--time-limit-ms is " + format_number(*options.time_limit_ms) +
                     ", it must be greater than 0 and at most " + format_number(kLongestMs));
  }
  // A search whose answer could not be kept would be in vain.
  for (const std::string& file :
       {options.json_file, options.plot_file, options.trace_file, options.landscape_file}) {
    if (!file.empty()) require_writable(file);
  }
}

Robot robot_of(const QueryOptions& options) {
  Robot robot = make_robot(options.view);
  set_counting(robot.sensor, options.view);
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

QueryAnswer ask_server(const QueryOptions& options) {
  PlannerClient client(options.server, options.tls);
  QueryAnswer answer;
  const PlanRequest request = request_of(options, *options.height_m);
  const Stopwatch calling;
  RemotePlan plan = client.plan(request, search_of(options.solver));
  answer.remote = {.server = options.server, .call_ms = calling.elapsed_ms()};
  answer.counting = plan.counting;
  answer.result = std::move(plan.result);
  return answer;
}

QueryAnswer search_map(const QueryOptions& options) {
  const Robot robot = robot_of(options);
  const auto solver = make_solver(search_of(options.solver));
  const ThreadLimit thread_limit(options.view);

  const Stopwatch loading;
  UncertaintyMap map = read_map(options.map_file);
  QueryAnswer answer;
  answer.evaluator = options.view.evaluator;
  answer.counting = robot.sensor.counting;
  answer.map_load_ms = loading.elapsed_ms();
  // Its time limit counts from here.
  const PlanRequest request = request_of(options, robot.mast.height_min_m);
  const ViewPlanner planner =
      ViewPlanner::with_given_sensor(std::move(map), robot, options.view.evaluator);
  answer.result = planner.plan(request, *solver);
  write_explanations(options, planner, answer.result);
  return answer;
}

void run_query(const QueryOptions& options) {
  check(options);
  const QueryAnswer answer = options.server.empty() ? search_map(options) : ask_server(options);
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

void add_situation(CLI::App& query, QueryOptions& options) {
  query.option_defaults()->group("Where the robot is");
  query.add_option("MAP", options.map_file, "a map: .bt or .ot; not with --server");
  query
      .add_option_function<std::string>(
          "--base",
          [&options](const std::string& text) {
            const auto base = numbers_argument("--base", text, {3, 4}, "X,Y,YAW or X,Y,Z,YAW");
            const double z_m = base.size() == 4 ? base[2] : 0.0;
            options.T_map_base = base_pose(base[0], base[1], z_m, base.back());
          },
          "the robot's base in the map: metres and radians, z is 0 when left out")
      ->type_name("X,Y[,Z],YAW")
      ->required();
  add_number(query, "--motion-time", options.motion_time_s, "SECONDS",
             "how long the joints may move; 0: no limit")
      ->required()
      ->default_str("");
  add_number(query, "--pan", options.pan_rad, "RAD", "pan now, counter-clockwise from above");
  add_number(query, "--tilt", options.tilt_rad, "RAD", "tilt now, positive looks up");
  add_number(query, "--height", options.height_m, "M",
             "height now, above the base [the mast's lowest]");
  query
      .add_option_function<std::string>(
          "--base-velocity",
          [&options](const std::string& text) {
            const auto v = numbers_argument("--base-velocity", text, {3}, "VX,VY,WZ");
            options.base_twist = {v[0], v[1], v[2]};
          },
          "the base's velocity in its own frame, which it keeps while the joints move: m/s and "
          "rad/s")
      ->type_name("VX,VY,WZ")
      ->default_str("0,0,0");
}

void add_search(CLI::App& query, QueryOptions& options) {
  query.option_defaults()->group("How to search");
  add_solver_arguments(query, options.solver);
  add_number(query, "--min-gain", options.min_gain, "GAIN",
             "with less than this to be had, stay and say no_gain_in_reach");
  add_whole_number(query, "--seed", options.seed, 0, kMaxWhole,
                   "of solvers that draw random numbers");
  add_number(query, "--time-limit-ms", options.time_limit_ms, "MS",
             "stop computing after this, from the map's load on, with the best so far [no limit]");
  add_whole_number(query, "--max-evals", options.max_evaluations, 1, kMaxWhole,
                   "stop after so many evaluations with the best so far [no limit]")
      ->default_str("");
}

void add_judgement(CLI::App& query, QueryOptions& options) {
  query.option_defaults()->group("How views are judged");
  add_view_arguments(query, options.view);
  add_number(query, "--occupied-uncertainty", options.occupied_uncertainty, "U",
             "0 to 1: u of an occupied voxel when the map carries none [as the robot says]");
}

void add_outputs(CLI::App& query, QueryOptions& options) {
  query.option_defaults()->group("What to write");
  query.add_flag("--json", options.json, "print one JSON object instead of text");
  query.add_option("--json-out", options.json_file, "also write the JSON object to a file")
      ->type_name("FILE");
  query.add_option("--plot", options.plot_file, "draw the map, the views, the gain and the search")
      ->type_name("OUT.png");
  query
      .add_option("--trace", options.trace_file,
                  "write every evaluation of the search, a JSON object a line")
      ->type_name("FILE");
  query
      .add_option("--landscape", options.landscape_file,
                  "write the gain over pan and tilt at the chosen height, as JSON")
      ->type_name("FILE");
}

void add_server(CLI::App& query, QueryOptions& options) {
  query.option_defaults()->group("Asking a server (nbvopt serve) that holds map and robot");
  CLI::Option* server =
      query.add_option("--server", options.server, "HOST:PORT or unix:PATH")->type_name("ADDRESS");
  const auto add_pem = [&](const char* name, std::filesystem::path& file, const char* description) {
    query.add_option(name, file, description)->type_name("PEM")->needs(server);
  };
  add_pem("--tls-ca", options.tls.server_ca, "who signs the server's certificate");
  add_pem("--tls-cert", options.tls.certificate, "the caller's certificate");
  add_pem("--tls-key", options.tls.key, "its private key");
  for (const char* ours : {"--robot", "--threads", "--evaluator", "--counting",
                           "--occupied-uncertainty", "--plot", "--trace", "--landscape"}) {
    query.get_option(ours)->excludes(server);
  }
}

}  // namespace

void set_up_query(CLI::App& app) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* query = app.add_subcommand("query", "Where should the camera look next?");
  add_situation(*query, *options);
  add_search(*query, *options);
  add_judgement(*query, *options);
  add_outputs(*query, *options);
  add_server(*query, *options);
  std::string solvers;
  for (const std::string& name : solver_names()) solvers += (solvers.empty() ? "" : ", ") + name;
  query->footer(
      "Solvers: " + solvers +
      ".\nA joint up to 0.01 rad or 5 mm beyond its limits is moved into them, with a warning.\n"
      "Example: nbvopt query map.ot --base -1.5,2,0.3 --tilt -0.2 --motion-time 0.5");
  query->callback([options] { run_query(*options); });
}

}  // namespace nbvopt
