#include "cli/calibrate.hpp"

#include <CLI/Option.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "cli/ask_server.hpp"
#include "cli/options/arguments.hpp"
#include "cli/options/server_arguments.hpp"
#include "cli/options/view_arguments.hpp"
#include "cli/options/world_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "cli/terminal/progress.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "sim/calibration_report.hpp"

namespace nbvopt {
namespace {

struct CalibrateOptions {
  std::vector<std::pair<std::string, std::string>> drives;  ///< world and trajectory
  ServerArguments server;                                   ///< or what this one has learnt
  WorldArguments world;                                     ///< how all of them are read
  RobotArguments robot;
  EpisodeOptions episode;
  double resolution_m = 0.1;
  std::int64_t seed = 1;
  std::string hazards_out;
  bool json = false;
  bool is_silent = false;
};

/// The drives, with their worlds, each read once.
class DrivenWorlds {
 public:
  explicit DrivenWorlds(const CalibrateOptions& options) {
    for (const auto& [world, trajectory] : options.drives) {
      drives_.push_back({world, scene(world, options), read_trajectory(trajectory)});
    }
  }

  const std::vector<CalibrationDrive>& drives() const { return drives_; }

 private:
  const Scene& scene(const std::string& world, const CalibrateOptions& options) {
    const auto known = scenes_.find(world);
    if (known != scenes_.end()) return *known->second;
    WorldArguments arguments = options.world;
    arguments.world_file = world;
    return *scenes_.emplace(world, std::make_unique<Scene>(read_world(arguments).mesh))
                .first->second;
  }

  std::map<std::string, std::unique_ptr<Scene>> scenes_;
  std::vector<CalibrationDrive> drives_;
};

/// What a server has learnt while it ran.
void take_from_server(const CalibrateOptions& options) {
  const HazardTable hazards = ask_server_for_hazards(options.server);
  if (!options.hazards_out.empty()) write_hazards(hazards, options.hazards_out);
  print_answer(options.json ? hazards_json(hazards) : to_text(hazards));
}

void run_calibrate(CalibrateOptions options) {
  if (options.drives.empty() == options.server.address.empty()) {
    throw UsageError("give --drive for each drive, or a --server that learns from its own");
  }
  if (!options.hazards_out.empty()) require_writable(options.hazards_out);
  if (!options.server.address.empty()) return take_from_server(options);
  const ThreadLimit thread_limit(options.robot);
  options.episode.robot = make_robot(options.robot);
  options.episode.seed = static_cast<std::uint64_t>(options.seed);
  options.episode.validate();
  const DrivenWorlds worlds(options);
  std::optional<Progress> progress;
  if (!options.is_silent) progress.emplace("calibrating", 1.0);
  const Calibration calibration =
      calibrate(worlds.drives(), options.episode, options.resolution_m, [&](double share) {
        if (progress) progress->update(share);
      });
  progress.reset();
  if (!options.hazards_out.empty()) write_hazards(calibration.hazards, options.hazards_out);
  print_answer(options.json ? to_text(to_json(calibration)) : to_text(calibration));
}

}  // namespace

void set_up_calibrate(CLI::App& app) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Learn from recorded drives how likely the unknown holds surfaces");
  calibrate
      ->add_option("--drive", options->drives,
                   "a world and a drive through it, which simulate --trajectory-out wrote; to be "
                   "given for each drive")
      ->type_name("WORLD TRAJECTORY");
  calibrate->add_option("--hazards-out", options->hazards_out, "what was learnt, for --hazards")
      ->type_name("FILE.json");
  add_number(*calibrate, "--motion-time", options->episode.motion_time_s, "SECONDS",
             "from one capture to the next; joints move within it");
  add_number(*calibrate, "--resolution", options->resolution_m, "M", "of the maps' voxels");
  add_whole_number(*calibrate, "--seed", options->seed, 0, std::numeric_limits<std::int64_t>::max(),
                   "of random views and noise");
  add_robot_and_threads(*calibrate, options->robot);
  add_world_reading_arguments(*calibrate, options->world);
  calibrate->add_flag("--json", options->json, "print one JSON object instead of text");
  calibrate->add_flag("--no-progress", options->is_silent, "show no progress bar");
  calibrate->option_defaults()->group("Asking a server (nbvopt serve) what its scans have taught");
  add_server_arguments(*calibrate, options->server);
  calibrate->footer(
      "Each drive is replayed twice with the expected gain: beginning with nothing, and with\n"
      "what the drives through the other worlds taught. Views are judged by what they realise.\n"
      "Example: nbvopt calibrate --drive a.world a.csv --drive b.world b.csv --hazards-out h.json");
  calibrate->callback([options] { run_calibrate(*options); });
}

}  // namespace nbvopt
