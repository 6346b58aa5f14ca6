#include "cli/options/query_arguments.hpp"

#include <CLI/Option.hpp>
#include <filesystem>
#include <limits>

#include "cli/options/arguments.hpp"
#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::int64_t kMaxWhole = std::numeric_limits<std::int64_t>::max();

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
  add_number(
      query, "--min-gain", options.min_gain, "GAIN",
      "with less than this to be had, stay and say no_gain_in_reach [1; 0 for gains other than "
      "positive and expected]");
  add_whole_number(query, "--seed", options.seed, 0, kMaxWhole,
                   "of solvers that draw random numbers");
  add_number(query, "--time-limit-ms", options.time_limit_ms, "MS",
             "stop computing after this, from the map's load on, with the best so far [no limit; a "
             "certificate takes 10 s at most]");
  add_whole_number(query, "--max-evals", options.max_evaluations, 1, kMaxWhole,
                   "stop after so many evaluations with the best so far [no limit]")
      ->default_str("");
  CLI::Option* certify = query.add_flag("--certify", options.certify,
                                        "prove how much a better view in reach could gain at most; "
                                        "of the gains positive and expected");
  add_number(query, "--gap", options.gap, "SHARE",
             "it is enough when a better view could add no more than this share [0.01]")
      ->needs(certify);
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
  CLI::Option* server = add_server_arguments(query, options.server);
  for (const char* ours : {"--robot", "--threads", "--evaluator", "--counting", "--hazards",
                           "--occupied-uncertainty", "--plot", "--trace", "--landscape"}) {
    query.get_option(ours)->excludes(server);
  }
}

}  // namespace

void add_query_arguments(CLI::App& query, QueryOptions& options) {
  add_situation(query, options);
  add_search(query, options);
  add_judgement(query, options);
  add_outputs(query, options);
  add_server(query, options);
}

void check(const QueryOptions& options) {
  if (options.map_file.empty() == options.server.address.empty()) {
    throw UsageError("name a MAP, or a server that holds one by --server, and not both");
  }
  if (!options.server.address.empty() && !options.height_m) {
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
  if (options.gap && !(*options.gap >= 0.0 && *options.gap < 1.0)) {
    throw InputError("--gap is " + format_number(*options.gap) +
                     ", it must be a share from 0 to less than 1, such as 0.01");
  }
  // A search whose answer could not be kept would be in vain.
  for (const std::string& file :
       {options.json_file, options.plot_file, options.trace_file, options.landscape_file}) {
    if (!file.empty()) require_writable(file);
  }
}

}  // namespace nbvopt
