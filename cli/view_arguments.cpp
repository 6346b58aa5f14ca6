#include "cli/view_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <utility>
#include <vector>

#include "cli/arguments.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot_fields.hpp"

namespace nbvopt {
namespace {

constexpr const char* kPaperCode = "paper-code";

}  // namespace

void add_robot_arguments(CLI::App& app, RobotArguments& arguments) {
  app.add_option("--robot", arguments.robot_file,
                 "robot and sensor, a YAML file [the paper's platform]")
      ->type_name("FILE");
  add_whole_number(app, "--threads", arguments.threads, 0, 1024,
                   "most threads to use; 0: all cores. Answers do not depend on it");
}

void add_view_arguments(CLI::App& app, ViewArguments& arguments) {
  app.add_option("--evaluator", arguments.evaluator,
                 "exact: every voxel that a ray pierces; paper-code: the paper's released code")
      ->check(CLI::IsMember({"exact", kPaperCode}))
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option("--counting", arguments.counting,
                 "per_ray: sum over rays; per_voxel: each voxel once (Eq. 13) [as the robot says]")
      ->check(CLI::IsMember({"per_ray", "per_voxel"}))
      ->type_name("NAME");
  add_robot_arguments(app, arguments);
}

ThreadLimit::ThreadLimit(const RobotArguments& arguments) {
  if (arguments.threads <= 0) return;
  limit_.emplace(tbb::global_control::max_allowed_parallelism,
                 static_cast<std::size_t>(arguments.threads));
}

Robot make_robot(const RobotArguments& arguments) {
  return arguments.robot_file.empty() ? Robot{} : read_robot(arguments.robot_file);
}

Robot make_robot(const ViewArguments& arguments) {
  Robot robot = make_robot(static_cast<const RobotArguments&>(arguments));
  if (arguments.evaluator == kPaperCode) robot.sensor = paper_code_sensor(robot.sensor);
  return robot;
}

void set_counting(SensorOptions& sensor, const ViewArguments& arguments) {
  if (arguments.counting.empty()) return;
  const std::vector<FieldSetting> settings{{"counting", arguments.counting}};
  set_fields(sensor, settings, "--counting");
}

std::unique_ptr<ViewEvaluator> make_evaluator(const std::string& name, const UncertaintyMap& map,
                                              std::shared_ptr<const VoxelGrid> grid,
                                              const SensorOptions& sensor) {
  if (name != kPaperCode) return make_exact_evaluator(std::move(grid), DepthCamera(sensor));
  if (sensor.counting == Counting::per_voxel) {
    throw UsageError("the paper-code evaluator counts per_ray only, use --evaluator exact");
  }
  return make_paper_code_evaluator(map, sensor);
}

}  // namespace nbvopt
