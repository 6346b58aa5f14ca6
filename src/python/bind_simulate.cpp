#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "nbvopt/core/error.hpp"
#include "python/arguments.hpp"
#include "python/sim_bindings.hpp"
#include "sim/localisation/localisation_output.hpp"

namespace nbvopt::python {
namespace {

/// Lets Python end what takes long, as Ctrl-C does.
void check_signals() {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

using Goals = std::optional<py::object>;
using Region = std::optional<py::object>;

Drive drive_through(const ReadyWorld& world, const py::object& start, const Goals& goals,
                    const Region& region, double lidar_range_m, double duration_max_s,
                    std::uint64_t seed) {
  DriveOptions options{.start = vector_from(start, "start")};
  if (goals) options.goals_map_m = plane_points_from(*goals, "goals");
  if (region) options.exploration.region_map_m = plane_points_from(*region, "region");
  options.exploration.mapping_range_m = lidar_range_m;
  options.exploration.duration_max_s = duration_max_s;
  options.exploration.seed = seed;
  options.exploration.world_map_m = seen_from_above(world.bounds_m);
  options.exploration.progress = [](double) { check_signals(); };
  const py::gil_scoped_release release;
  return make_drive(world.scene, options);
}

Drive explore_world(const WorldArgument& world, const py::object& start, const Goals& goals,
                    double lidar_range_m, double duration_max_s, std::int64_t seed,
                    const Region& region) {
  const std::uint64_t trees_seed = seed_from(seed);
  return drive_through(*world_from(world), start, goals, region, lidar_range_m, duration_max_s,
                       trees_seed);
}

/// A drive to replay: itself, or its file.
using DriveArgument = std::variant<std::shared_ptr<Drive>, std::filesystem::path>;

Drive drive_from(const DriveArgument& trajectory) {
  if (const auto* drive = std::get_if<std::shared_ptr<Drive>>(&trajectory)) {
    return {(*drive)->trajectory};
  }
  return {read_trajectory(std::get<std::filesystem::path>(trajectory))};
}

/// Runs the episode. Whatever ends it early has the map so far as its attribute `map`.
EpisodeReport run_or_hand_out_map(Simulation& simulation, const Scene& scene,
                                  const Trajectory& trajectory) {
  const auto hand_out_map = [&](const py::object& exception) {
    exception.attr("map") = std::make_shared<SharedMap>(std::move(simulation.map()));
  };
  try {
    const py::gil_scoped_release release;
    return simulation.run(scene, trajectory, [](const Capture&) { check_signals(); });
  } catch (const py::error_already_set& stopped) {
    hand_out_map(stopped.value());
    throw;
  } catch (const Error& error) {
    const py::object exception = py::handle(PyExc_ValueError)(error.what());
    hand_out_map(exception);
    PyErr_SetObject(PyExc_ValueError, exception.ptr());
    throw py::error_already_set();
  }
}

std::unique_ptr<Episode> simulate(
    const WorldArgument& world_argument, const std::optional<py::object>& start, const Goals& goals,
    const std::optional<DriveArgument>& replayed, double lidar_range_m, double duration_max_s,
    const std::string& mode, double motion_time_s, const py::object& joints, const Robot& robot,
    const std::optional<double>& capture_hz, bool charge_computing, double range_noise_m,
    double resolution_m, std::int64_t seed, const Region& region, const std::string& pose_source,
    double odometry_noise, bool score_map, bool has_people) {
  if (!start && !replayed) {
    throw InputError("give a start to explore from, or a trajectory to replay");
  }
  if (replayed && (start || goals || region)) {
    throw InputError("trajectory holds the whole drive: leave start, goals and region out");
  }
  SimulationOptions options;
  options.mode = mode;
  options.resolution_m = resolution_m;
  options.episode = {.robot = robot,
                     .start_joints = joint_position_from(joints),
                     .motion_time_s = motion_time_s,
                     .capture_hz = capture_hz,
                     .charge_computing = charge_computing,
                     .range_noise_m = range_noise_m,
                     .hazards = {},
                     .seed = seed_from(seed)};
  LocalisationOptions& localisation = options.episode.localisation;
  localisation.source = pose_source_of(pose_source);
  localisation.odometry_noise = odometry_noise;
  localisation.lidar_range_m = lidar_range_m;
  options.episode.scores_map = score_map || localisation.source != PoseSource::truth;
  options.world = name_of(world_argument);
  Simulation simulation(options);
  const SharedWorld world = world_from(world_argument);
  if (has_people) simulation.set_people(world->people);
  const Drive drive = replayed ? drive_from(*replayed)
                               : drive_through(*world, *start, goals, region, lidar_range_m,
                                               duration_max_s, options.episode.seed);
  EpisodeReport report = run_or_hand_out_map(simulation, world->scene, drive.trajectory);
  report.drive_status = drive.status;
  return std::make_unique<Episode>(
      Episode{drive, robot, simulation.captures(), report,
              std::make_shared<SharedMap>(std::move(simulation.map()))});
}

constexpr const char* kExploreText =
    "Drives through a world without a camera, and returns the Drive: what `nbvopt simulate "
    "--explore-only` does, to the last bit.\n\n"
    "world: a World, or the path of one. start: (x, y, yaw) or (x, y, z, yaw) in the map; without "
    "z the base starts on the floor.\n"
    "goals: (N, 2), x and y in the map; visited in turn instead of exploring.\n"
    "lidar_range_m: beams are cropped here for the map in the plane.\n"
    "duration_max_s: when the exploration must end. seed: of its random trees.\n"
    "region: (N, 2), the corners of a polygon in which frontiers and goals must lie; None: all "
    "that "
    "the world shows but planes, and lidar_range_m around it.\n\n"
    "ValueError: a wrong shape, no floor below the start, a start that is not free, a goal that "
    "cannot be reached.";

constexpr const char* kSimulateText =
    "Runs an episode of mapping and returns it as an Episode: what `nbvopt simulate` does, to the "
    "last bit.\n\n"
    "world, start, goals, lidar_range_m, duration_max_s, region: as explore() has them.\n"
    "trajectory: a Drive to replay instead, or the path of one; without start, goals and region.\n"
    "mode: how the next view is chosen: \"static\", \"grid\", \"grid-3\", \"auto\" or \"random\".\n"
    "motion_time_s: from one capture to the next; joints move within it.\n"
    "joints: (pan, tilt, height) at the start. robot: whose camera and mast it is.\n"
    "capture_hz: also capture while joints move, so often.\n"
    "charge_computing: let the base drive on while the computer maps and plans.\n"
    "range_noise_m: standard deviation of the camera's ranges.\n"
    "resolution_m: of the map's voxels.\n"
    "seed: of exploration, noise, people, and modes that draw random numbers.\n"
    "pose_source: how the base knows where it is: \"truth\", \"odom\" (wheels that err, times "
    "odometry_noise) or \"slam\" (wheels and lidar). score_map: judge the map by the world, which "
    "is always done where poses err.\n"
    "people: whether the world's actors walk.\n\n"
    "ValueError: a mode that is not known, joints beyond their limits, a number out of range, and "
    "as explore(). What ends the episode before the drive does, Ctrl-C too, has the Map so far as "
    "its attribute `map`.";

}  // namespace

void bind_simulate(py::module_& module) {
  const ExplorationOptions exploration;
  const SimulationOptions defaults;
  module.def("explore", &explore_world, py::arg("world"), py::arg("start"), py::kw_only(),
             py::arg("goals") = py::none(), py::arg("lidar_range_m") = exploration.mapping_range_m,
             py::arg("duration_max_s") = exploration.duration_max_s, py::arg("seed") = 1,
             py::arg("region") = py::none(), kExploreText);
  module.def("simulate", &simulate, py::arg("world"), py::kw_only(), py::arg("start") = py::none(),
             py::arg("goals") = py::none(), py::arg("trajectory") = py::none(),
             py::arg("lidar_range_m") = exploration.mapping_range_m,
             py::arg("duration_max_s") = exploration.duration_max_s,
             py::arg("mode") = defaults.mode,
             py::arg("motion_time_s") = defaults.episode.motion_time_s,
             py::arg("joints") = py::make_tuple(defaults.episode.start_joints.pan_rad,
                                                defaults.episode.start_joints.tilt_rad,
                                                defaults.episode.start_joints.height_m),
             py::arg_v("robot", Robot{}, "Robot()"), py::arg("capture_hz") = py::none(),
             py::arg("charge_computing") = false, py::arg("range_noise_m") = 0.0,
             py::arg("resolution_m") = defaults.resolution_m, py::arg("seed") = 1,
             py::arg("region") = py::none(), py::arg("pose_source") = "truth",
             py::arg("odometry_noise") = defaults.episode.localisation.odometry_noise,
             py::arg("score_map") = false, py::arg("people") = true, kSimulateText);
}

}  // namespace nbvopt::python
