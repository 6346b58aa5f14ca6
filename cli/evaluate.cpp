#include "cli/evaluate.hpp"

#include <CLI/Option.hpp>
#include <iostream>
#include <memory>
#include <utility>

#include "cli/map_input.hpp"
#include "cli/options/view_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/json.hpp"
#include "core/stopwatch.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "planner/pose_file.hpp"

namespace nbvopt {
namespace {

struct EvaluateOptions {
  std::string map_file;
  std::string pose_file;
  ViewArguments view;
};

PoseFile read_pose_file(const std::string& path, const Robot& robot) {
  if (path == "-") {
    return parse_pose_file(read_text(std::cin, "standard input"), "standard input", robot);
  }
  return parse_pose_file(read_text_file(path), path, robot);
}

Json to_json(const ViewGain& view) {
  return {{"gain", view.gain},
          {"unknown_rays", view.unknown_rays},
          {"occupied_rays", view.occupied_rays},
          {"free_rays", view.free_rays},
          {"unknown_gain", view.unknown_gain},
          {"occupied_gain", view.occupied_gain}};
}

void check_on_lattice(const PoseFile& poses, const Lattice& lattice, const std::string& file) {
  for (std::size_t i = 0; i < poses.poses_T_map_sensor.size(); ++i) {
    if (!lattice.contains(poses.poses_T_map_sensor[i].translation())) {
      throw InputError(file + ": cases[" + std::to_string(i) +
                       "]: the camera is off the map's lattice of 65536 voxels an axis");
    }
  }
}

void run_evaluate(const EvaluateOptions& options) {
  Robot robot = make_robot(options.view);
  const PoseFile poses = read_pose_file(options.pose_file, robot);
  robot.sensor = poses.sensor;
  set_counting_and_gain(robot.sensor, options.view);
  const ThreadLimit thread_limit(options.view);

  const std::optional<HazardTable> hazards = given_hazards(options.view);
  const Stopwatch loading;
  UncertaintyMap map = read_map_input({.file = options.map_file});
  const double map_load_ms = loading.elapsed_ms();
  check_on_lattice(poses, map.lattice(), options.pose_file);

  ViewPlanner planner =
      ViewPlanner::with_given_sensor(std::move(map), robot, options.view.evaluator);
  if (hazards) planner.set_hazards(*hazards);
  const Stopwatch evaluating;
  const std::vector<ViewGain> gains = planner.evaluate(poses.poses_T_map_sensor);
  const double time_ms = evaluating.elapsed_ms();

  Json cases = Json::array();
  for (const ViewGain& gain : gains) cases.push_back(to_json(gain));
  const double rays =
      double{1} * robot.sensor.horizontal_rays * robot.sensor.vertical_rays * gains.size();
  print_answer(to_text({{"map", options.map_file},
                        {"evaluator", options.view.evaluator},
                        {"counting", to_string(robot.sensor.counting)},
                        {"map_load_ms", map_load_ms},
                        {"time_ms", time_ms},
                        {"rays_per_second", rays / time_ms * 1e3},
                        {"cases", std::move(cases)}}));
}

}  // namespace

void set_up_evaluate(CLI::App& app) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App* evaluate = app.add_subcommand("evaluate", "What given views of a map are worth");
  evaluate->add_option("MAP", options->map_file, "a map: .bt or .ot")->required();
  evaluate
      ->add_option("--poses", options->pose_file,
                   "the views, a JSON file; -: standard input. It holds \"cases\": [...], each "
                   "\"position\": [x,y,z] and \"orientation_xyzw\": [...] of the optical frame, or "
                   "\"base\": {x,y,z,yaw} with \"pan\", \"tilt\", \"height\"; and, if need be, "
                   "\"sensor\": {...} with keys of the robot file's sensor block")
      ->type_name("FILE")
      ->required();
  add_view_arguments(*evaluate, options->view);
  evaluate->add_flag("--json")->description("print one JSON object, as is always done");
  evaluate->footer(
      "Prints one JSON object; its \"cases\", in the input's order, hold gain, unknown_rays,\n"
      "occupied_rays and free_rays. Joint limits do not bind.\n"
      "Example: nbvopt evaluate map.ot --poses views.json");
  evaluate->callback([options] { run_evaluate(*options); });
}

}  // namespace nbvopt
