#include "sim/simulation.hpp"

#include <utility>

#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/floor.hpp"
#include "nbvopt/sim/view_exploration.hpp"
#include "nbvopt/sim/volume_exploration.hpp"

namespace nbvopt {
namespace {

double floor_below(const Scene& scene, const Eigen::Vector3d& above_map_m) {
  const std::optional<double> z_m = floor_height_m(scene, above_map_m);
  if (z_m) return *z_m;
  throw InputError("start: there is no floor below z = " + format_number(above_map_m.z()) +
                   " m, give x, y, z, yaw");
}

Transform start_pose(const std::vector<double>& start, const Scene& scene) {
  if (start.size() != 3 && start.size() != 4) {
    throw InputError("start has " + std::to_string(start.size()) +
                     " numbers, it must be x, y, yaw or x, y, z, yaw");
  }
  // Above what a robot can stand on, below tables and ceilings.
  constexpr double kAboveFloor_m = 0.5;
  const double z_m =
      start.size() == 4 ? start[2] : floor_below(scene, {start[0], start[1], kAboveFloor_m});
  return base_pose(start[0], start[1], z_m, start.back());
}

Exploration exploration(const Scene& scene, const Transform& T_map_base,
                        const DriveOptions& options) {
  const auto T_base_sensor = [&] {
    std::vector<std::string> warnings;
    const Mast mast(options.episode.robot.mast);
    return mast.T_base_sensor(mast.clamped(options.episode.start_joints, warnings));
  };
  switch (options.explorer) {
    case ExplorerKind::plane:
      return explore(scene, T_map_base, options.exploration);
    case ExplorerKind::volume:
      return explore_volume(scene, T_map_base, T_base_sensor(), VolumeExplorer::bai2016,
                            options.exploration);
    case ExplorerKind::volume_tekniker:
      return explore_volume(scene, T_map_base, T_base_sensor(), VolumeExplorer::tekniker,
                            options.exploration);
    case ExplorerKind::volume_after_plane:
      return explore_volume_after_plane(scene, T_map_base, T_base_sensor(), VolumeExplorer::bai2016,
                                        options.exploration);
    case ExplorerKind::views:
      return explore_views(scene, T_map_base,
                           {.drive = options.exploration,
                            .episode = options.episode,
                            .resolution_m = options.resolution_m})
          .exploration;
  }
  throw UsageError("there is no such explorer");
}

}  // namespace

Eigen::AlignedBox2d seen_from_above(const Eigen::AlignedBox3d& bounds_m) {
  if (bounds_m.isEmpty()) return {};
  return {bounds_m.min().head<2>(), bounds_m.max().head<2>()};
}

Drive make_drive(const Scene& scene, const DriveOptions& options) {
  const Transform T_map_base = start_pose(options.start, scene);
  Exploration made = options.goals_map_m.empty()
                         ? exploration(scene, T_map_base, options)
                         : drive_to(scene, T_map_base, options.goals_map_m, options.exploration);
  return {std::move(made.trajectory), made.status};
}

DriveReport report_of(const Drive& drive, const DriveOptions& options, const std::string& world) {
  return {.world = world,
          .start = options.start,
          .status = drive.status.value(),
          .duration_s = drive.trajectory.duration_s(),
          .length_m = drive.trajectory.length_m(),
          .seed = options.exploration.seed};
}

Simulation::Simulation(SimulationOptions options)
    : options_(std::move(options)),
      mode_(make_camera_mode(options_.mode)),
      map_(options_.resolution_m) {
  options_.episode.validate();
}

EpisodeReport Simulation::run(const Scene& scene, const Trajectory& trajectory,
                              const std::function<void(const Capture&)>& observe) {
  const Stopwatch stopwatch;
  StepTimer timer;
  EpisodeReport report;
  report.summary =
      run_episode(scene, trajectory, *mode_, options_.episode, map_, [&](const Capture& capture) {
        timer.add(capture);
        captures_.push_back(capture);
        observe(capture);
      });
  report.world = options_.world;
  report.mode = options_.mode;
  report.motion_time_s = options_.episode.motion_time_s;
  report.seed = options_.episode.seed;
  report.pose_source = options_.episode.localisation.source;
  report.paper_counts = map_.paper_counts();
  report.times = timer.mean();
  report.elapsed_ms = stopwatch.elapsed_ms();
  return report;
}

}  // namespace nbvopt
