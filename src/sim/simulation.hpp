// A simulation as users run it: the base drives by itself, and the camera maps along the drive.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/sim/camera_mode.hpp"
#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/exploration.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "sim/episode_output.hpp"
#include "sim/explorer_kind.hpp"

namespace nbvopt {

struct DriveOptions {
  std::vector<double> start = {};  ///< x, y, yaw or x, y, z, yaw in the map; without z on the floor
  std::vector<Eigen::Vector2d> goals_map_m = {};  ///< driven to in turn; empty: the base explores
  ExplorerKind explorer = ExplorerKind::plane;
  ExplorationOptions exploration = {};
  /// How explorers look that explore space, and what their map is like.
  EpisodeOptions episode = {};
  double resolution_m = 0.1;
};

/// A box from above, as ExplorationOptions::world_map_m takes a world's; empty where that is.
Eigen::AlignedBox2d seen_from_above(const Eigen::AlignedBox3d& bounds_m);

/// What an episode follows, and how it came about where it was made just now.
struct Drive {
  Trajectory trajectory;
  std::optional<ExplorationStatus> status = {};  ///< none: replayed
};

/// Explores, or drives to the goals. Throws InputError as explore() and drive_to() do, and when
/// there is no floor below the start.
Drive make_drive(const Scene& scene, const DriveOptions& options);

/// Tells of a drive that was made with these options, in the world of that name.
DriveReport report_of(const Drive& drive, const DriveOptions& options, const std::string& world);

struct SimulationOptions {
  std::string world;          ///< its name in the report
  std::string mode = "auto";  ///< one of camera_mode_names()
  EpisodeOptions episode;
  double resolution_m = 0.1;  ///< of the map's voxels
};

/// An episode, with its mode, that maps from nothing.
class Simulation {
 public:
  /// Throws InputError for what run_episode() would refuse, and UsageError for an unknown mode:
  /// before a world is read or a drive made.
  explicit Simulation(SimulationOptions options);

  /// Lets people walk through the world, who are known once it is read. The camera sees them, the
  /// lidar of slam if asked to.
  void set_people(People people, bool lidar_sees_them = false) {
    if (lidar_sees_them) options_.episode.localisation.people = people;
    options_.episode.people = std::move(people);
  }

  /// Runs the episode as run_episode() does; to be called once.
  EpisodeReport run(const Scene& scene, const Trajectory& trajectory,
                    const std::function<void(const Capture&)>& observe);

  const SimulationOptions& options() const { return options_; }
  const std::vector<Capture>& captures() const { return captures_; }  ///< so far
  const UncertaintyMap& map() const { return map_; }                  ///< so far
  UncertaintyMap& map() { return map_; }

 private:
  SimulationOptions options_;
  std::unique_ptr<const CameraMode> mode_;
  std::vector<Capture> captures_;
  UncertaintyMap map_;
};

}  // namespace nbvopt
