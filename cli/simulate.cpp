#include "cli/simulate.hpp"

#include <CLI/Option.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/episode_output.hpp"
#include "cli/output.hpp"
#include "cli/plot_episode.hpp"
#include "cli/progress.hpp"
#include "cli/view_arguments.hpp"
#include "cli/world_arguments.hpp"
#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/floor.hpp"

namespace nbvopt {
namespace {

constexpr std::int64_t kMaxWhole = std::numeric_limits<std::int64_t>::max();

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
  std::string trajectory_out;
  std::string map_out;
  std::string metrics_out;
  std::string summary_out;
  std::string plot_out;
};

void check(const SimulateOptions& options) {
  if (options.trajectory_file.empty() && options.start.empty()) {
    throw UsageError("give --start X,Y,YAW to explore from, or --trajectory FILE to replay");
  }
  if (!options.trajectory_file.empty() && !(options.start.empty() && options.goals_m.empty())) {
    throw UsageError("--trajectory holds the whole drive: leave --start and --goal out");
  }
  if (options.is_exploring_only && !options.trajectory_file.empty()) {
    throw UsageError("--explore-only makes a trajectory: leave --trajectory out");
  }
  // An episode whose outcome could not be kept would be in vain.
  for (const std::string& file : {options.trajectory_out, options.map_out, options.metrics_out,
                                  options.summary_out, options.plot_out}) {
    if (!file.empty()) require_writable(file);
  }
}

Transform start_pose(const SimulateOptions& options, const Scene& scene) {
  // Above what a robot can stand on, below tables and ceilings.
  constexpr double kAboveFloor_m = 0.5;
  const std::vector<double>& start = options.start;
  const double z_m = start.size() == 4
                         ? start[2]
                         : floor_height_m(scene, {start[0], start[1], kAboveFloor_m}).value_or(0.0);
  return base_pose(start[0], start[1], z_m, start.back());
}

Exploration drive(const SimulateOptions& options, const Scene& scene) {
  ExplorationOptions exploration = options.exploration;
  exploration.seed = static_cast<std::uint64_t>(options.seed);
  std::optional<Progress> progress;
  if (!options.is_silent) {
    progress.emplace("exploring, at most", exploration.duration_max_s);
    exploration.progress = [&](double time_s) { progress->update(time_s); };
  }
  const Transform T_map_base = start_pose(options, scene);
  return options.goals_m.empty() ? explore(scene, T_map_base, exploration)
                                 : drive_to(scene, T_map_base, options.goals_m, exploration);
}

/// The drive that an episode replays, and how it came about where it was made just now.
struct Drive {
  Trajectory trajectory;
  std::optional<ExplorationStatus> status;
};

Drive make_drive(const SimulateOptions& options, const Scene& scene) {
  if (!options.trajectory_file.empty()) {
    return {read_trajectory(options.trajectory_file), std::nullopt};
  }
  const Exploration exploration = drive(options, scene);
  if (!options.trajectory_out.empty()) {
    write_trajectory(exploration.trajectory, options.trajectory_out);
  }
  return {exploration.trajectory, exploration.status};
}

void answer(const SimulateOptions& options, const Json& json, const std::string& text) {
  if (!options.summary_out.empty()) write_file_atomically(options.summary_out, to_text(json));
  print_answer(options.json ? to_text(json) : text);
}

void tell_drive(const SimulateOptions& options, const Drive& drive) {
  const std::string status =
      drive.status == ExplorationStatus::complete ? "complete" : "time_limit";
  const double duration_s = drive.trajectory.duration_s();
  const double length_m = drive.trajectory.length_m();
  answer(options,
         {{"world", options.world.world_file},
          {"start", options.start},
          {"status", status},
          {"duration_s", duration_s},
          {"length_m", length_m},
          {"seed", options.seed}},
         "exploration " + status + ": " + format_number(length_m) + " m in " +
             format_number(duration_s) + " s\n");
}

std::string subtitle(const EpisodeReport& report) {
  return std::filesystem::path(report.world).filename().string() + ", mode " + report.mode +
         ", t = " + format_number(report.motion_time_s) +
         " s: " + std::to_string(report.summary.captures) + " captures, " +
         std::to_string(report.summary.voxels) + " voxels with u < 1, information " +
         std::to_string(std::llround(report.summary.information));
}

/// Runs the episode; whatever ends it, the map so far is written.
EpisodeReport run_and_keep(const SimulateOptions& options, const Scene& scene,
                           const Trajectory& trajectory) {
  EpisodeOptions episode = options.episode;
  episode.robot = make_robot(options.robot);
  episode.seed = static_cast<std::uint64_t>(options.seed);
  const auto mode = make_camera_mode(options.mode);

  UncertaintyMap map(options.resolution_m);
  const auto keep_map = [&] {
    if (!options.map_out.empty()) write_map(map, options.map_out, MapFormat::uncertainty_ot);
  };
  std::optional<CaptureLog> log;
  if (!options.metrics_out.empty()) log.emplace(options.metrics_out);
  std::optional<Progress> progress;
  if (!options.is_silent) progress.emplace("simulating", trajectory.duration_s());
  StepTimer timer;
  std::vector<Capture> captures;
  const Stopwatch stopwatch;
  EpisodeReport report;
  try {
    report.summary =
        run_episode(scene, trajectory, *mode, episode, map, [&](const Capture& capture) {
          timer.add(capture);
          if (log) log->add(capture);
          if (!options.plot_out.empty()) captures.push_back(capture);
          if (progress) progress->update(capture.time_s);
        });
  } catch (const InputError&) {
    keep_map();
    throw;
  }
  keep_map();
  report.world = options.world.world_file;
  report.mode = options.mode;
  report.motion_time_s = episode.motion_time_s;
  report.seed = episode.seed;
  report.paper_counts = map.paper_counts();
  report.times = timer.mean();
  report.elapsed_ms = stopwatch.elapsed_ms();
  if (!options.plot_out.empty()) {
    write_episode_plot({map, episode.robot, captures, subtitle(report)}, options.plot_out);
  }
  return report;
}

void run_simulate(const SimulateOptions& options) {
  check(options);
  const ThreadLimit thread_limit(options.robot);
  const Scene scene(read_world(options.world).mesh);
  const Drive drive = make_drive(options, scene);
  if (options.is_exploring_only) return tell_drive(options, drive);
  const EpisodeReport report = run_and_keep(options, scene, drive.trajectory);
  answer(options, to_json(report), to_text(report));
}

void add_drive(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("How the base drives");
  simulate
      .add_option_function<std::string>(
          "--start",
          [&options](const std::string& text) {
            options.start = numbers_argument("--start", text, {3, 4}, "X,Y,YAW or X,Y,Z,YAW");
          },
          "where it starts to explore: metres and radians; z is the floor's when left out")
      ->type_name("X,Y[,Z],YAW");
  simulate
      .add_option_function<std::vector<std::string>>(
          "--goal",
          [&options](const std::vector<std::string>& goals) {
            for (const std::string& goal : goals) {
              const auto numbers = numbers_argument("--goal", goal, {2}, "X,Y");
              options.goals_m.emplace_back(numbers[0], numbers[1]);
            }
          },
          "drive here instead of exploring; several are visited in turn")
      ->type_name("X,Y");
  simulate
      .add_option("--trajectory", options.trajectory_file,
                  "replay this drive, a CSV file that --trajectory-out wrote")
      ->type_name("FILE");
  add_number(simulate, "--lidar-range", options.exploration.mapping_range_m, "M",
             "beams are cropped here for the map in the plane");
  add_number(simulate, "--duration-max", options.exploration.duration_max_s, "SECONDS",
             "end the exploration then");
  simulate.add_flag("--explore-only", options.is_exploring_only, "drive and leave the camera off");
}

void add_camera(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("What the camera does");
  std::string modes;
  for (const std::string& name : camera_mode_names()) modes += (modes.empty() ? "" : ", ") + name;
  simulate.add_option("--mode", options.mode, "how the next view is chosen: " + modes)
      ->type_name("NAME")
      ->capture_default_str();
  add_number(simulate, "--motion-time", options.episode.motion_time_s, "SECONDS",
             "from one capture to the next; joints move within it");
  add_number(simulate, "--pan", options.episode.start_joints.pan_rad, "RAD", "pan at the start");
  add_number(simulate, "--tilt", options.episode.start_joints.tilt_rad, "RAD", "tilt at the start");
  add_number(simulate, "--height", options.episode.start_joints.height_m, "M",
             "height at the start, above the base");
  add_number(simulate, "--capture-hz", options.episode.capture_hz, "HZ",
             "also capture while joints move, so often [no]");
  simulate.add_flag("--charge-computing", options.episode.charge_computing,
                    "let the base drive on while the computer maps and plans");
  add_number(simulate, "--range-noise", options.episode.range_noise_m, "M",
             "standard deviation of the camera's ranges");
  add_number(simulate, "--resolution", options.resolution_m, "M", "of the map's voxels");
  add_whole_number(simulate, "--seed", options.seed, 0, kMaxWhole,
                   "of exploration, noise, and modes that draw random numbers");
  add_robot_arguments(simulate, options.robot);
}

void add_outputs(CLI::App& simulate, SimulateOptions& options) {
  simulate.option_defaults()->group("What to write");
  const auto add_file = [&simulate](const char* name, std::string& target, const char* type,
                                    const char* description) {
    simulate.add_option(name, target, description)->type_name(type);
  };
  add_file("--map-out", options.map_out, "FILE.ot", "the map, also when the episode fails");
  add_file("--metrics", options.metrics_out, "FILE.jsonl", "a JSON object a capture, as they come");
  add_file("--trajectory-out", options.trajectory_out, "FILE.csv", "the drive, to be replayed");
  add_file("--summary", options.summary_out, "FILE.json", "the answer as JSON, written last");
  add_file("--plot", options.plot_out, "OUT.png", "the map from above with the drive on it");
  simulate.add_flag("--json", options.json, "print the answer as JSON instead of text");
  simulate.add_flag("--no-progress", options.is_silent, "show no progress bar");
}

}  // namespace

void set_up_simulate(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* simulate = app.add_subcommand("simulate", "An episode of mapping in a simulated world");
  simulate->option_defaults()->group("Which world");
  add_world_arguments(*simulate, options->world);
  add_drive(*simulate, *options);
  add_camera(*simulate, *options);
  add_outputs(*simulate, *options);
  simulate->footer(
      "Without --charge-computing the same arguments give the same map on every run and for any\n"
      "number of threads.\n"
      "Example: nbvopt simulate small_house.world --start 0,0,0 --mode auto --motion-time 0.5");
  simulate->callback([options] { run_simulate(*options); });
}

}  // namespace nbvopt
