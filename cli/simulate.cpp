#include "cli/simulate.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "cli/options/simulate_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/progress.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "plot/episode_plot.hpp"
#include "sim/simulation.hpp"

namespace nbvopt {
namespace {

DriveOptions drive_options(const SimulateOptions& options) {
  DriveOptions drive = options.drive;
  drive.exploration.seed = static_cast<std::uint64_t>(options.seed);
  return drive;
}

Drive drive_itself(const SimulateOptions& options, const Scene& scene) {
  DriveOptions drive = drive_options(options);
  std::optional<Progress> progress;
  if (!options.is_silent) {
    progress.emplace("exploring, at most", drive.exploration.duration_max_s);
    drive.exploration.progress = [&](double time_s) { progress->update(time_s); };
  }
  return make_drive(scene, drive);
}

Drive drive_of(const SimulateOptions& options, const Scene& scene) {
  if (!options.trajectory_file.empty()) return {read_trajectory(options.trajectory_file)};
  Drive drive = drive_itself(options, scene);
  if (!options.trajectory_out.empty()) write_trajectory(drive.trajectory, options.trajectory_out);
  return drive;
}

void answer(const SimulateOptions& options, const Json& json, const std::string& text) {
  if (!options.summary_out.empty()) write_file_atomically(options.summary_out, to_text(json));
  print_answer(options.json ? to_text(json) : text);
}

void tell_drive(const SimulateOptions& options, const Drive& drive) {
  const DriveReport report = report_of(drive, drive_options(options), options.world.world_file);
  answer(options, to_json(report), to_text(report));
}

/// The episode that was asked for, found good before anything takes its time.
Simulation simulation_of(const SimulateOptions& options) {
  SimulationOptions simulation = options.simulation;
  simulation.world = options.world.world_file;
  simulation.episode.robot = make_robot(options.robot);
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
  if (!options.plot_out.empty()) {
    write_file_atomically(options.plot_out,
                          episode_plot_png({simulation.map(), simulation.options().episode.robot,
                                            simulation.captures(), report}));
  }
  return report;
}

void run_simulate(const SimulateOptions& options) {
  check(options);
  const ThreadLimit thread_limit(options.robot);
  Simulation simulation = simulation_of(options);
  const Scene scene(read_world(options.world).mesh);
  const Drive drive = drive_of(options, scene);
  if (options.is_exploring_only) return tell_drive(options, drive);
  const EpisodeReport report = run_and_keep(options, scene, drive.trajectory, simulation);
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
