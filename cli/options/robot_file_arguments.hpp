// The options that say which robot: its file and, for a URDF, what that does not say.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "nbvopt/planner/robot.hpp"

namespace nbvopt {

struct RobotFileArguments {
  std::string file;  ///< YAML or URDF; empty: the paper's platform
  UrdfOptions urdf;
};

/// Adds --robot with the options of a URDF.
void add_robot_file(CLI::App& app, RobotFileArguments& arguments);

/// Adds --camera-link, --base-link and --camera-axes, where the file is told otherwise.
void add_urdf_options(CLI::App& app, UrdfOptions& options);

/// The robot of the file; what it leaves out is as `defaults` have it. What was doubtful about a
/// URDF is printed as warnings.
Robot read_robot(const RobotFileArguments& arguments, Robot defaults);

/// Reads a URDF and prints what was doubtful about it.
UrdfMast read_urdf_with_warnings(const std::string& text, const std::string& file,
                                 const UrdfOptions& options);

}  // namespace nbvopt
