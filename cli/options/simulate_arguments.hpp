// The options of nbvopt simulate.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/view_arguments.hpp"
#include "cli/options/world_arguments.hpp"
#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/exploration.hpp"

namespace nbvopt {

struct SimulateOptions {
  WorldArguments world;
  RobotArguments robot;
  std::vector<double> start;  ///< X,Y,YAW or X,Y,Z,YAW; empty: none given
  std::vector<Eigen::Vector2d> goals_m;
  std::string trajectory_file;  ///< empty: the robot drives by itself
  ExplorationOptions exploration;
  bool is_exploring_only = false;
  std::string mode = "auto";
  EpisodeOptions episode;
  double resolution_m = 0.1;
  std::int64_t seed = 1;
  bool json = false;
  bool is_silent = false;
  std::string trajectory_out;  ///< this and all below: empty, do not write
  std::string map_out;
  std::string metrics_out;
  std::string summary_out;
  std::string plot_out;
};

void add_simulate_arguments(CLI::App& simulate, SimulateOptions& options);

/// Throws UsageError for options that contradict each other, and InputError for a file that could
/// not be written in the end.
void check(const SimulateOptions& options);

}  // namespace nbvopt
