#include "cli/options/view_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <vector>

#include "cli/options/arguments.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

/// Empty where the text is a gain or a sum of gains; else what is wrong with it.
std::string is_gain(const std::string& text) {
  GainChoice gain;
  const std::string demand = store(text, gain);
  return demand.empty() ? "" : "'" + text + "' must be " + demand;
}

void set_gain(SensorOptions& sensor, const RobotArguments& arguments) {
  sensor.gain = gain_of(arguments).value_or(sensor.gain);
}

}  // namespace

void add_robot_and_threads(CLI::App& app, RobotArguments& arguments) {
  add_robot_file(app, arguments.robot);
  add_whole_number(app, "--threads", arguments.threads, 0, 1024,
                   "most threads to use; 0: all cores. Answers do not depend on it");
}

void add_robot_arguments(CLI::App& app, RobotArguments& arguments) {
  add_robot_and_threads(app, arguments);
  app.add_option("--gain", arguments.gain,
                 "positive: the first unknown voxel is a surface (Eq. 12); expected: surfaces come "
                 "with probabilities, learnt where scans are inserted; the gains of others by name "
                 "(docs/guide/gains.md); or a sum such as positive + 0.5*rear_side_voxel "
                 "[as the robot says, or " +
                     to_string(arguments.default_gain) + "]")
      ->check(is_gain, "a gain")
      ->type_name("GAIN");
  app.add_option("--hazards", arguments.hazards_file,
                 "what an expected gain takes for likely of the unknown: a file that simulate or "
                 "calibrate wrote by --hazards-out, or a server's snapshot [what the drives "
                 "of docs/results.md taught]")
      ->type_name("FILE");
}

void add_view_arguments(CLI::App& app, ViewArguments& arguments) {
  app.add_option("--evaluator", arguments.evaluator,
                 "exact: every voxel that a ray pierces; paper-code: the paper's released code")
      ->check(CLI::IsMember(evaluator_names()))
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option("--counting", arguments.counting,
                 "per_ray: sum over rays; per_voxel: each voxel once (Eq. 13) [as the robot says]")
      ->check(CLI::IsMember(enum_names<Counting>()))
      ->type_name("NAME");
  add_robot_arguments(app, arguments);
}

ThreadLimit::ThreadLimit(const RobotArguments& arguments) {
  if (arguments.threads <= 0) return;
  limit_.emplace(tbb::global_control::max_allowed_parallelism,
                 static_cast<std::size_t>(arguments.threads));
}

Robot make_robot(const RobotArguments& arguments) {
  Robot robot;
  robot.sensor.gain = arguments.default_gain;
  robot = read_robot(arguments.robot, robot);
  set_gain(robot.sensor, arguments);
  return robot;
}

Robot make_robot(const ViewArguments& arguments) {
  Robot robot = make_robot(static_cast<const RobotArguments&>(arguments));
  robot.sensor = evaluator_sensor(arguments.evaluator, robot.sensor);
  return robot;
}

std::optional<GainChoice> gain_of(const RobotArguments& arguments) {
  if (arguments.gain.empty()) return std::nullopt;
  GainChoice gain;
  store(arguments.gain, gain);  // which was checked when it was read
  return gain;
}

std::optional<HazardTable> given_hazards(const RobotArguments& arguments) {
  if (arguments.hazards_file.empty()) return std::nullopt;
  return read_hazards(arguments.hazards_file);
}

void set_counting_and_gain(SensorOptions& sensor, const ViewArguments& arguments) {
  set_gain(sensor, arguments);
  if (arguments.counting.empty()) return;
  sensor.counting = enum_value<Counting>(arguments.counting).value();
}

}  // namespace nbvopt
