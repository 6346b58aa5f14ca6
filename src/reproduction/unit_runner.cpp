#include "reproduction/unit_runner.hpp"

#include <utility>
#include <variant>

#include "core/atomic_file.hpp"
#include "experiment/digest.hpp"
#include "nbvopt/core/error.hpp"
#include "plot/episode_plot.hpp"
#include "sim/simulation.hpp"

namespace nbvopt {
namespace {

Json answer(const SimulationUnit& unit, const DriveSetting& setting, const Scene& scene,
            const Eigen::AlignedBox2d& world_map_m) {
  DriveOptions options;
  options.start = {setting.start.x_m, setting.start.y_m, setting.start.yaw_rad};
  options.exploration.mapping_range_m = setting.lidar_range_m;
  options.exploration.duration_max_s = setting.duration_max_s;
  options.exploration.seed = unit.seed;
  options.exploration.world_map_m = world_map_m;
  options.explorer = setting.explorer;
  const Drive drive = make_drive(scene, options);
  write_trajectory(drive.trajectory, unit.trajectory);
  return to_json(report_of(drive, options, unit.world.file.string()));
}

Json answer(const SimulationUnit& unit, const EpisodeSetting& setting, const Scene& scene,
            const Eigen::AlignedBox2d& /*world_map_m*/) {
  SimulationOptions options;
  options.world = unit.world.file.string();
  options.mode = setting.mode;
  options.episode.motion_time_s = setting.motion_time_s;
  options.episode.robot.sensor.gain = setting.gain;
  options.episode.seed = unit.seed;
  Simulation simulation(std::move(options));
  const EpisodeReport report =
      simulation.run(scene, read_trajectory(unit.trajectory), [](const Capture&) {});
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
  const Scene& in = scene(unit.world);
  Json result = std::visit(
      [&](const auto& setting) { return answer(unit, setting, in, world_map_m_); }, unit.setting);
  if (!warnings_.empty() && std::holds_alternative<DriveSetting>(unit.setting)) {
    result["warnings"] = warnings_;
  }
  result["trajectory_digest"] = experiment::file_digest(unit.trajectory);
  return result;
}

const Scene& UnitRunner::scene(const WorldSource& world) {
  if (!scene_ || world_file_ != world.file || world_digest_ != world.digest) {
    scene_.reset();  // first: two big worlds need not fit into memory
    World read = read_world(world);
    if (world_digest(read) != world.digest) {
      throw InputError(world.file.string() + " has changed since the reproduction began");
    }
    scene_ = std::make_unique<Scene>(read.mesh);
    world_map_m_ = seen_from_above(read.bounds_m);
    warnings_ = std::move(read.warnings);
    world_file_ = world.file;
    world_digest_ = world.digest;
  }
  return *scene_;
}

}  // namespace nbvopt
