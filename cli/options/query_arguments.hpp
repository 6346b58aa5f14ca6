// The options of nbvopt query.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/options/server_arguments.hpp"
#include "cli/options/solver_arguments.hpp"
#include "cli/options/view_arguments.hpp"
#include "nbvopt/planner/plan.hpp"

namespace nbvopt {

struct QueryOptions {
  std::string map_file;  ///< empty: the server's
  ServerArguments server;
  Transform T_map_base = Transform::Identity();
  BaseTwist base_twist;
  double pan_rad = 0.0;
  double tilt_rad = 0.0;
  std::optional<double> height_m;  ///< none: the mast's lowest
  double motion_time_s = 0.0;
  ViewArguments view;
  std::optional<double> occupied_uncertainty;  ///< none: as the robot says
  SolverArguments solver;
  std::optional<double> min_gain;  ///< none: as PlanRequest says
  std::int64_t seed = 1;
  std::optional<double> time_limit_ms;
  std::int64_t max_evaluations = StopRule{}.max_evaluations;
  bool certify = false;
  std::optional<double> gap;  ///< none: as CertifyOptions says
  bool json = false;
  std::string json_file;
  std::string plot_file;
  std::string trace_file;
  std::string landscape_file;
};

void add_query_arguments(CLI::App& query, QueryOptions& options);

/// What no option can see by itself. Throws UsageError or InputError that names the option.
void check(const QueryOptions& options);

}  // namespace nbvopt
