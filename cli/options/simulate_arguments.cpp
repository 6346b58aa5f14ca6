#include "cli/options/simulate_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <limits>

#include "cli/options/arguments.hpp"
#include "cli/options/region_argument.hpp"
#include "core/atomic_file.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/localisation/pose_source_names.hpp"

namespace nbvopt {
namespace {

void add_drive(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("How the base drives");
  simulate
      .add_option_function<std::string>(
          "--start",
          [&options](const std::string& text) {
            options.drive.start = numbers_argument("--start", text, {3, 4}, "X,Y,YAW or X,Y,Z,YAW");
          },
          "where it starts to explore: metres and radians; z is the floor's when left out [the "
          "first "
          "free place, as nbvopt world info lists them]")
      ->type_name("X,Y[,Z],YAW");
  simulate
      .add_option(
          "--explore", options.explorer,
          "who chooses where it drives: 2d, the frontiers of the lidar's map; 3d, views that would "
          "show most of the unknown (Bai et al., 2016), seldom done before --duration-max; "
          "3d-tekniker, the same as the paper's authors ran it; 3d-after-2d, 3d from where 2d "
          "ends; "
          "nbv, what the camera has to learn a second, looking as --mode auto does [2d]")
      ->type_name("NAME")
      ->check(CLI::IsMember(enum_names<ExplorerKind>()));
  simulate
      .add_option_function<std::vector<std::string>>(
          "--goal",
          [&options](const std::vector<std::string>& goals) {
            for (const std::string& goal : goals) {
              const auto numbers = numbers_argument("--goal", goal, {2}, "X,Y");
              options.drive.goals_map_m.emplace_back(numbers[0], numbers[1]);
            }
          },
          "drive here instead of exploring; several are visited in turn")
      ->type_name("X,Y");
  simulate
      .add_option_function<std::string>(
          "--region",
          [&options](const std::string& text) {
            options.drive.exploration.region_map_m = region_argument(text);
          },
          "explore only here, whatever lies beyond: a rectangle, or a file with a corner x,y a "
          "line")
      ->type_name("X0,Y0,X1,Y1|FILE");
  simulate.add_flag(
      "--open-ground", options.explores_open_ground,
      "explore farther than the lidar sees beyond all that the world shows but planes");
  simulate
      .add_option("--trajectory", options.trajectory_file,
                  "replay this drive, a CSV file that --trajectory-out wrote")
      ->type_name("FILE");
  add_number(simulate, "--lidar-range", options.drive.exploration.mapping_range_m, "M",
             "beams are cropped here for the map in the plane");
  add_number(simulate, "--duration-max", options.drive.exploration.duration_max_s, "SECONDS",
             "end the exploration then");
  simulate.add_flag("--explore-only", options.is_exploring_only, "drive and leave the camera off");
}

void add_camera(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("What the camera does");
  std::string modes;
  for (const std::string& name : camera_mode_names()) modes += (modes.empty() ? "" : ", ") + name;
  simulate.add_option("--mode", options.simulation.mode, "how the next view is chosen: " + modes)
      ->type_name("NAME")
      ->capture_default_str();
  add_number(simulate, "--motion-time", options.simulation.episode.motion_time_s, "SECONDS",
             "from one capture to the next; joints move within it");
  add_number(simulate, "--pan", options.simulation.episode.start_joints.pan_rad, "RAD",
             "pan at the start");
  add_number(simulate, "--tilt", options.simulation.episode.start_joints.tilt_rad, "RAD",
             "tilt at the start");
  add_number(simulate, "--height", options.simulation.episode.start_joints.height_m, "M",
             "height at the start, above the base");
  add_number(simulate, "--capture-hz", options.simulation.episode.capture_hz, "HZ",
             "also capture while joints move, so often [no]");
  simulate.add_flag("--charge-computing", options.simulation.episode.charge_computing,
                    "let the base drive on while the computer maps and plans");
  add_number(simulate, "--range-noise", options.simulation.episode.range_noise_m, "M",
             "standard deviation of the camera's ranges");
  add_number(simulate, "--resolution", options.simulation.resolution_m, "M", "of the map's voxels");
  add_whole_number(simulate, "--seed", options.seed, 0, std::numeric_limits<std::int64_t>::max(),
                   "of exploration, noise, people, and modes that draw random numbers");
  options.robot.default_gain = GainKind::expected;
  add_robot_arguments(simulate, options.robot);
}

void add_localisation(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("How the base knows where it is");
  LocalisationOptions& localisation = options.simulation.episode.localisation;
  simulate
      .add_option_function<std::string>(
          "--pose-source",
          [&localisation](const std::string& name) {
            localisation.source = enum_value<PoseSource>(name).value();
          },
          "truth: exactly; odom: by wheels that err; slam: by wheels and lidar, a particle filter. "
          "Views are planned and mapped with this pose; the drive itself is made with the true one "
          "[truth]")
      ->check(CLI::IsMember(enum_names<PoseSource>()))
      ->type_name("NAME");
  add_number(simulate, "--odometry-noise", localisation.odometry_noise, "FACTOR",
             "multiplies the errors of the wheels, those of GMapping's motion model");
  simulate.add_flag("--score-map", options.simulation.episode.scores_map,
                    "judge the map by the world: precision, recall, information of true voxels; "
                    "always done where poses err");
}

void add_outputs(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("What to write");
  const auto add_file = [&simulate](const char* name, std::string& target, const char* type,
                                    const char* description) {
    simulate.add_option(name, target, description)->type_name(type);
  };
  add_file("--map-out", options.map_out, "FILE.ot", "the map, also when the episode fails");
  add_file("--hazards-out", options.hazards_out, "FILE.json",
           "what an expected gain has learnt, for --hazards");
  add_file("--metrics", options.metrics_out, "FILE.jsonl", "a JSON object a capture, as they come");
  add_file("--trajectory-out", options.trajectory_out, "FILE.csv", "the drive, to be replayed");
  add_file("--summary", options.summary_out, "FILE.json", "the answer as JSON, written last");
  add_file("--plot", options.plot_out, "OUT.png", "the map from above with the drive on it");
  simulate.add_flag("--json", options.json, "print the answer as JSON instead of text");
  simulate.add_flag("--no-progress", options.is_silent, "show no progress bar");
}

}  // namespace

void add_simulate_arguments(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("Which world");
  add_world_arguments(simulate, options.world);
  simulate.add_flag("!--without-people", options.has_people, "leave out the world's actors");
  simulate.add_flag("--lidar-sees-people", options.lidar_sees_people,
                    "let actors hide from the lidar what is behind them, while the base explores "
                    "and where --pose-source slam goes by it");
  add_drive(simulate, options);
  add_camera(simulate, options);
  add_localisation(simulate, options);
  add_outputs(simulate, options);
}

void check(const SimulateOptions& options) {
  if (!options.trajectory_file.empty() &&
      !(options.drive.start.empty() && options.drive.goals_map_m.empty() &&
        options.drive.exploration.region_map_m.empty())) {
    throw UsageError("--trajectory holds the whole drive: leave --start, --goal and --region out");
  }
  if (!options.explorer.empty() &&
      !(options.trajectory_file.empty() && options.drive.goals_map_m.empty())) {
    throw UsageError("--explore chooses where to drive: leave it or --goal and --trajectory out");
  }
  const bool uses_lidar = options.trajectory_file.empty() ||
                          options.simulation.episode.localisation.source == PoseSource::slam;
  if (options.lidar_sees_people && !(options.has_people && uses_lidar)) {
    throw UsageError(
        "--lidar-sees-people is for a drive that is made among people, or --pose-source slam on "
        "one that is replayed: leave it, or --without-people and --trajectory, out");
  }
  if (options.is_exploring_only && !options.trajectory_file.empty()) {
    throw UsageError("--explore-only makes a trajectory: leave --trajectory out");
  }
  if (!options.trajectory_file.empty() && !options.trajectory_out.empty()) {
    throw UsageError("--trajectory-out keeps a drive that is made: leave it or --trajectory out");
  }
  if (options.is_exploring_only && !(options.map_out.empty() && options.hazards_out.empty() &&
                                     options.metrics_out.empty() && options.plot_out.empty())) {
    throw UsageError(
        "--explore-only maps nothing: leave --map-out, --hazards-out, --metrics and --plot out");
  }
  const EpisodeOptions& episode = options.simulation.episode;
  if (options.is_exploring_only && episode.localisation.source != PoseSource::truth) {
    throw UsageError("--explore-only drives with the true pose: leave --pose-source out");
  }
  // An episode whose outcome could not be kept would be in vain.
  for (const std::string& file : {options.trajectory_out, options.map_out, options.hazards_out,
                                  options.metrics_out, options.summary_out, options.plot_out}) {
    if (!file.empty()) require_writable(file);
  }
}

}  // namespace nbvopt
