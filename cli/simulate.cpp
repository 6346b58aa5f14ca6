#include "cli/simulate.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "cli/options/simulate_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/progress.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/sim/floor.hpp"
#include "plot/episode_plot.hpp"
#include "sim/episode_output.hpp"

namespace nbvopt {
namespace {

double floor_below(const Scene& scene, const Eigen::Vector3d& above_map_m) {
  const std::optional<double> z_m = floor_height_m(scene, above_map_m);
  if (z_m) return *z_m;
  throw InputError("--start: there is no floor below z = " + format_number(above_map_m.z()) +
                   " m, write X,Y,Z,YAW");
}

Transform start_pose(const SimulateOptions& options, const Scene& scene) {
  // Above what a robot can stand on, below tables and ceilings.
  constexpr double kAboveFloor_m = 0.5;
  const std::vector<double>& start = options.start;
  const double z_m =
      start.size() == 4 ? start[2] : floor_below(scene, {start[0], start[1], kAboveFloor_m});
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
         "exploration " + status + ": " + decimal(length_m, 1) + " m in " + decimal(duration_s, 1) +
             " s\n");
}

std::string subtitle(const EpisodeReport& report) {
  return std::filesystem::path(report.world).filename().string() + ", mode " + report.mode +
         ", t = " + format_number(report.motion_time_s) +
         " s: " + std::to_string(report.summary.captures) + " captures, " +
         std::to_string(report.summary.voxels) + " voxels with u < 1, information " +
         std::to_string(std::llround(report.summary.information));
}

/// What is to be run, found good before anything takes its time.
struct Episode {
  std::unique_ptr<CameraMode> mode;
  EpisodeOptions options;
  UncertaintyMap map;
};

Episode make_episode(const SimulateOptions& options) {
  Episode episode{make_camera_mode(options.mode), options.episode,
                  UncertaintyMap(options.resolution_m)};
  episode.options.robot = make_robot(options.robot);
  episode.options.seed = static_cast<std::uint64_t>(options.seed);
  episode.options.validate();
  return episode;
}

/// Runs the episode; whatever error ends it, the map so far is written.
EpisodeReport run_and_keep(const SimulateOptions& options, const Scene& scene,
                           const Trajectory& trajectory, Episode& episode) {
  UncertaintyMap& map = episode.map;
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
    report.summary = run_episode(scene, trajectory, *episode.mode, episode.options, map,
                                 [&](const Capture& capture) {
                                   timer.add(capture);
                                   if (log) log->add(capture);
                                   if (!options.plot_out.empty()) captures.push_back(capture);
                                   if (progress) progress->update(capture.time_s);
                                 });
  } catch (const InputError& error) {
    try {
      keep_map();
    } catch (const InputError& of_map) {
      throw InputError(std::string(error.what()) + "; nor is the map kept: " + of_map.what());
    }
    throw;
  }
  keep_map();
  report.world = options.world.world_file;
  report.mode = options.mode;
  report.motion_time_s = episode.options.motion_time_s;
  report.seed = episode.options.seed;
  report.paper_counts = map.paper_counts();
  report.times = timer.mean();
  report.elapsed_ms = stopwatch.elapsed_ms();
  if (!options.plot_out.empty()) {
    write_episode_plot({map, episode.options.robot, captures, subtitle(report)}, options.plot_out);
  }
  return report;
}

void run_simulate(const SimulateOptions& options) {
  check(options);
  const ThreadLimit thread_limit(options.robot);
  Episode episode = make_episode(options);
  const Scene scene(read_world(options.world).mesh);
  const Drive drive = make_drive(options, scene);
  if (options.is_exploring_only) return tell_drive(options, drive);
  const EpisodeReport report = run_and_keep(options, scene, drive.trajectory, episode);
  answer(options, to_json(report), to_text(report));
}

}  // namespace

void set_up_simulate(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* simulate = app.add_subcommand("simulate", "An episode of mapping in a simulated world");
  add_simulate_arguments(*simulate, *options);
  simulate->footer(
      "Without --charge-computing the same arguments give the same map on every run and for any\n"
      "number of threads.\n"
      "Example: nbvopt simulate small_house.world --start 0,0,0 --mode auto --motion-time 0.5");
  simulate->callback([options] { run_simulate(*options); });
}

}  // namespace nbvopt
