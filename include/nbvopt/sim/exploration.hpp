// A robot that explores a plane by itself, or drives where it is told: where trajectories come
// from.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/sim/occupancy_grid.hpp"
#include "nbvopt/sim/people.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/simulated_lidar.hpp"
#include "nbvopt/sim/trajectory.hpp"

namespace nbvopt {

/// An omnidirectional base, the default about a TurtleBot3 Waffle with the paper's speeds.
struct BaseOptions {
  double radius_m = 0.22;
  double speed_max_m_s = 0.25;
  double turn_rate_max_rad_s = 0.52;
  double acceleration_max_m_s2 = 0.5;
  double turn_acceleration_max_rad_s2 = 1.0;
};

struct ExplorationOptions {
  BaseOptions base;
  LidarOptions lidar;
  double mapping_range_m = 4.0;  ///< beams are cropped here, as in the paper
  double cell_m = 0.05;          ///< of the occupancy grid
  std::uint64_t seed = 1;        ///< of the trees
  double duration_max_s = 7200.0;
  std::stop_token stop =
      {};  ///< a request ends the exploration where it is, as duration_max_s does
  /// Frontiers and goals must lie in this polygon (x, y in the map), which closes itself; empty:
  /// they may lie anywhere.
  std::vector<Eigen::Vector2d> region_map_m = {};
  /// The box of all that the world shows but planes; empty: not known. More than mapping_range_m
  /// beyond it lies open ground, where nothing is to be found: unless there is a region, frontiers
  /// there are left alone.
  Eigen::AlignedBox2d world_map_m = {};
  /// Whom the lidar sees: they hide what is behind them. The seed is theirs, too. Empty: nobody.
  People people = {};
  std::function<void(double time_s)> progress;  ///< called now and then; may throw to end it
};

enum class ExplorationStatus {
  complete,     ///< no frontier, or nothing else worth a way, is left that can be reached
  open_ground,  ///< but some are left alone on open ground
  time_limit,   ///< duration_max_s, or a request to stop, came first
};
std::string to_string(ExplorationStatus status);

/// A drive and the plane map that it made.
struct Exploration {
  ExplorationStatus status;
  Trajectory trajectory;
  OccupancyGrid grid;
};

/// Explores all that can be reached from the start, with frontiers found by rapidly-exploring
/// random trees after Umari and Mukhopadhyay. Localisation is perfect. The same seed gives the same
/// trajectory. Throws InputError when the start is not free (in or at a wall) or lies outside of
/// the region, or an option is bad.
Exploration explore(const Scene& scene, const Transform& T_map_base,
                    const ExplorationOptions& options);

/// Drives to the goals (x, y in the map) in turn, through what is free or not yet known, planning
/// again as the lidar shows more. Throws InputError as above, and when a goal cannot be reached or
/// lies outside of the region (named with its number and position).
Exploration drive_to(const Scene& scene, const Transform& T_map_base,
                     std::span<const Eigen::Vector2d> goals_map_m,
                     const ExplorationOptions& options);

}  // namespace nbvopt
