#include "cli/simulate.hpp"

#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "cli/options/simulate_arguments.hpp"
#include "cli/options/start_place.hpp"
#include "cli/terminal/end_by_signal.hpp"
#include "cli/terminal/held_signals.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/progress.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "nbvopt/map/map_file.hpp"
#include "plot/episode_plot.hpp"
#include "sim/simulation.hpp"

namespace nbvopt {
namespace {

/// A world that can be cast at.
struct ReadyWorld {
  explicit ReadyWorld(const World& world)
      : bounds_m(world.bounds_m), people(world.people), scene(world.mesh) {}

  Eigen::AlignedBox3d bounds_m;
  People people;
  Scene scene;
};

/// The drive that was asked for, from the first free place where no start was given.
DriveOptions drive_options(const SimulateOptions& options, const SimulationOptions& simulation,
                           const ReadyWorld& world) {
  DriveOptions drive = options.drive;
  drive.explorer = enum_value<ExplorerKind>(options.explorer).value_or(drive.explorer);
  drive.exploration.seed = simulation.episode.seed;
  drive.episode = simulation.episode;
  if (options.has_people) drive.episode.people = world.people;
  drive.resolution_m = simulation.resolution_m;
  if (!options.explores_open_ground) {
    drive.exploration.world_map_m = seen_from_above(world.bounds_m);
  }
  if (options.lidar_sees_people) drive.exploration.people = world.people;
  if (!drive.start.empty()) return drive;
  drive.start = first_start(world.scene, world.bounds_m, drive.exploration);
  print_message("starts at " + pose_text(drive.start) +
                ", a free place; --start X,Y,YAW chooses another");
  return drive;
}

void tell_end(const Drive& drive) {
  if (drive.status != ExplorationStatus::open_ground) return;
  print_message(
      "the exploration ends where only open ground is left, beyond all that the world shows; "
      "--open-ground explores it, too, --region bounds it elsewhere");
}

/// What a drive came to, and the signal that ended it, if one did.
struct StoppableDrive {
  Drive drive;
  std::optional<int> stopped_by;
};

/// With signals held a drive ends where it is when one comes.
StoppableDrive drive_itself(const SimulateOptions& options, const Scene& scene, DriveOptions drive,
                            const std::optional<HeldSignals>& signals) {
  std::optional<Progress> progress;
  if (!options.is_silent) {
    progress.emplace("exploring, at most", drive.exploration.duration_max_s);
  }
  std::stop_source stop;
  std::optional<int> stopped_by;
  drive.exploration.stop = stop.get_token();
  drive.exploration.progress = [&](double time_s) {
    if (progress) progress->update(time_s);
    if (signals && !stopped_by) stopped_by = signals->take();
    if (stopped_by) stop.request_stop();
  };
  Drive made = make_drive(scene, drive);
  return {std::move(made), stopped_by};
}

/// Makes the drive and keeps it, as far as it came, where that was asked for. Lets the signals go.
Drive drive_of(const SimulateOptions& options, const Scene& scene, const DriveOptions& asked,
               std::optional<HeldSignals>& signals) {
  auto [drive, stopped_by] = drive_itself(options, scene, asked, signals);
  signals.reset();
  if (!options.trajectory_out.empty()) write_trajectory(drive.trajectory, options.trajectory_out);
  if (stopped_by) {
    end_by(*stopped_by,
           "the drive so far is in " + options.trajectory_out + "; --trajectory replays it");
  }
  tell_end(drive);
  return drive;
}

void answer(const SimulateOptions& options, const Json& json, const std::string& text) {
  if (!options.summary_out.empty()) write_file_atomically(options.summary_out, to_text(json));
  print_answer(options.json ? to_text(json) : text);
}

void tell_drive(const SimulateOptions& options, const Drive& drive, const DriveOptions& asked) {
  const DriveReport report = report_of(drive, asked, options.world.world_file);
  answer(options, to_json(report), to_text(report));
}

/// The episode that was asked for, found good before anything takes its time.
Simulation simulation_of(const SimulateOptions& options) {
  SimulationOptions simulation = options.simulation;
  simulation.world = options.world.world_file;
  simulation.episode.robot = make_robot(options.robot);
  simulation.episode.hazards = given_hazards(options.robot);
  if (!options.hazards_out.empty() &&
      !simulation.episode.robot.sensor.gain.has(GainKind::expected)) {
    throw UsageError("--hazards-out keeps what an expected gain learns: add --gain expected");
  }
  LocalisationOptions& localisation = simulation.episode.localisation;
  localisation.lidar_range_m = options.drive.exploration.mapping_range_m;
  simulation.episode.scores_map |= localisation.source != PoseSource::truth;
  simulation.episode.seed = static_cast<std::uint64_t>(options.seed);
  return Simulation(std::move(simulation));
}

/// Runs the episode; whatever error ends it, the map so far is written.
EpisodeReport run_and_keep(const SimulateOptions& options, const Scene& scene,
                           const Trajectory& trajectory, Simulation& simulation) {
  const auto keep_map = [&] {
    if (options.map_out.empty()) return;
    write_map(simulation.map(), options.map_out, MapFormat::uncertainty_ot);
  };
  std::optional<CaptureLog> log;
  if (!options.metrics_out.empty()) log.emplace(options.metrics_out);
  std::optional<Progress> progress;
  if (!options.is_silent) progress.emplace("simulating", trajectory.duration_s());
  EpisodeReport report;
  try {
    report = simulation.run(scene, trajectory, [&](const Capture& capture) {
      if (log) log->add(capture);
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
  if (!options.hazards_out.empty()) write_hazards(report.summary.hazards, options.hazards_out);
  if (!options.plot_out.empty()) {
    write_file_atomically(options.plot_out,
                          episode_plot_png({simulation.map(), simulation.options().episode.robot,
                                            simulation.captures(), report}));
  }
  return report;
}

void tell_episode(const SimulateOptions& options, const ReadyWorld& world, const Drive& drive,
                  Simulation& simulation) {
  if (options.has_people) simulation.set_people(world.people, options.lidar_sees_people);
  EpisodeReport report = run_and_keep(options, world.scene, drive.trajectory, simulation);
  report.drive_status = drive.status;
  answer(options, to_json(report), to_text(report));
}

void run_simulate(const SimulateOptions& options) {
  check(options);
  const ThreadLimit thread_limit(options.robot);
  Simulation simulation = simulation_of(options);
  std::optional<HeldSignals> signals;  // before reading starts threads, which would die of one
  if (!options.trajectory_out.empty()) signals.emplace();
  const ReadyWorld world(read_world(options.world));
  if (!options.trajectory_file.empty()) {
    return tell_episode(options, world, {read_trajectory(options.trajectory_file)}, simulation);
  }
  const DriveOptions asked = drive_options(options, simulation.options(), world);
  const Drive drive = drive_of(options, world.scene, asked, signals);
  if (options.is_exploring_only) return tell_drive(options, drive, asked);
  tell_episode(options, world, drive, simulation);
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
