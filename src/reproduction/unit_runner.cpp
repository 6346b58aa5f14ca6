#include "reproduction/unit_runner.hpp"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/atomic_file.hpp"
#include "experiment/digest.hpp"
#include "nbvopt/core/error.hpp"
#include "plot/episode_plot.hpp"
#include "sim/simulation.hpp"

namespace nbvopt {

/// What the units of one world share.
struct KeptWorld {
  explicit KeptWorld(World&& read)
      : scene(read.mesh),
        seen_from_above_m(seen_from_above(read.bounds_m)),
        people(std::move(read.people)),
        warnings(std::move(read.warnings)) {}

  Scene scene;
  Eigen::AlignedBox2d seen_from_above_m;
  People people;
  std::vector<std::string> warnings;
};

namespace {

Json answer(const SimulationUnit& unit, const DriveSetting& setting, const KeptWorld& world) {
  DriveOptions options;
  options.start = {setting.start.x_m, setting.start.y_m, setting.start.yaw_rad};
  options.exploration.mapping_range_m = setting.lidar_range_m;
  options.exploration.duration_max_s = setting.duration_max_s;
  options.exploration.seed = unit.seed;
  options.exploration.world_map_m = world.seen_from_above_m;
  options.explorer = setting.explorer;
  options.episode.robot.sensor.gain = GainKind::expected;  // as nbvopt simulate has it
  options.episode.seed = unit.seed;
  options.episode.people = world.people;
  const Drive drive = make_drive(world.scene, options);
  write_trajectory(drive.trajectory, unit.trajectory);
  return to_json(report_of(drive, options, unit.world.file.string()));
}

Json answer(const SimulationUnit& unit, const EpisodeSetting& setting, const KeptWorld& world) {
  SimulationOptions options;
  options.world = unit.world.file.string();
  options.mode = setting.mode;
  options.episode.motion_time_s = setting.motion_time_s;
  options.episode.robot.sensor.gain = setting.gain;
  options.episode.seed = unit.seed;
  options.episode.people = world.people;
  Simulation simulation(std::move(options));
  const EpisodeReport report =
      simulation.run(world.scene, read_trajectory(unit.trajectory), [](const Capture&) {});
  if (!unit.picture.empty()) {
    write_file_atomically(unit.picture,
                          episode_map_png({simulation.map(), simulation.options().episode.robot,
                                           simulation.captures(), report}));
  }
  return to_json(report);
}

}  // namespace

UnitRunner::UnitRunner() = default;
UnitRunner::~UnitRunner() = default;

Json UnitRunner::run(const SimulationUnit& unit) {
  const KeptWorld& in = world(unit.world);
  Json result =
      std::visit([&](const auto& setting) { return answer(unit, setting, in); }, unit.setting);
  if (!in.warnings.empty() && std::holds_alternative<DriveSetting>(unit.setting)) {
    result["warnings"] = in.warnings;
  }
  result["trajectory_digest"] = experiment::file_digest(unit.trajectory);
  return result;
}

const KeptWorld& UnitRunner::world(const WorldSource& source) {
  if (!world_ || world_file_ != source.file || world_digest_ != source.digest) {
    world_.reset();  // first: two big worlds need not fit into memory
    World read = read_world(source);
    if (world_digest(read) != source.digest) {
      throw InputError(source.file.string() + " has changed since the reproduction began");
    }
    world_ = std::make_unique<KeptWorld>(std::move(read));
    world_file_ = source.file;
    world_digest_ = source.digest;
  }
  return *world_;
}

}  // namespace nbvopt
