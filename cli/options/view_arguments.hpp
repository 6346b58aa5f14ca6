// The options that say how views are judged; shared by the commands that judge views.
#pragma once

#include <tbb/global_control.h>

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "cli/options/robot_file_arguments.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt {

/// What every command that has a robot asks for.
struct RobotArguments {
  RobotFileArguments robot;
  GainKind default_gain = GainKind::positive;  ///< where neither `gain` nor the robot says
  std::string gain;                            ///< empty: as the robot says
  std::string hazards_file;                    ///< of an expected gain; empty: nothing was learnt
  std::int64_t threads = 0;
};

struct ViewArguments : RobotArguments {
  std::string evaluator = "exact";
  std::string counting;  ///< empty: as the robot says
};

/// The robot's file and the number of threads alone.
void add_robot_and_threads(CLI::App& app, RobotArguments& arguments);
/// Commands that learn from scans have the expected gain by default.
void add_robot_arguments(CLI::App& app, RobotArguments& arguments);
void add_view_arguments(CLI::App& app, ViewArguments& arguments);

/// Holds the process to the threads that were asked for, while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(const RobotArguments& arguments);

 private:
  std::optional<tbb::global_control> limit_;  ///< none: all cores
};

/// The robot of the file, with the gain that was asked for.
Robot make_robot(const RobotArguments& arguments);

/// The same, its sensor as the evaluator wants it.
Robot make_robot(const ViewArguments& arguments);

/// The gain, if one was asked for.
std::optional<GainChoice> gain_of(const RobotArguments& arguments);

/// The hazards of the file, if one was given.
std::optional<HazardTable> given_hazards(const RobotArguments& arguments);

/// Sets counting and gain where they were asked for: the command line wins over files.
void set_counting_and_gain(SensorOptions& sensor, const ViewArguments& arguments);

}  // namespace nbvopt
