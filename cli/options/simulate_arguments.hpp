// The options of nbvopt simulate.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "cli/options/view_arguments.hpp"
#include "cli/options/world_arguments.hpp"
#include "sim/simulation.hpp"

namespace nbvopt {

struct SimulateOptions {
  WorldArguments world;
  RobotArguments robot;
  DriveOptions drive;    ///< without a start: the world's first free place
  std::string explorer;  ///< of ExplorerKind's names; empty: as the drive has it
  bool explores_open_ground = false;
  bool has_people = true;  ///< those of the world
  bool lidar_sees_people = false;
  std::string trajectory_file;  ///< empty: the robot drives by itself
  bool is_exploring_only = false;
  SimulationOptions simulation;
  std::int64_t seed = 1;
  bool json = false;
  bool is_silent = false;
  std::string trajectory_out;  ///< this and all below: empty, do not write
  std::string map_out;
  std::string hazards_out;
  std::string metrics_out;
  std::string summary_out;
  std::string plot_out;
};

void add_simulate_arguments(CLI::App& simulate, SimulateOptions& options);

/// Throws UsageError for options that contradict each other, and InputError for a file that could
/// not be written in the end.
void check(const SimulateOptions& options);

}  // namespace nbvopt
