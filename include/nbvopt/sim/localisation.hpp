// How a base knows where it is, and how wrong it is about it.
#pragma once

#include <cstdint>

#include "nbvopt/sim/people.hpp"
#include "nbvopt/sim/simulated_lidar.hpp"

namespace nbvopt {

/// Where the pose of the base comes from that views are planned and mapped with.
enum class PoseSource : std::uint8_t {
  truth,  ///< it is known exactly, as in the paper's experiment
  odom,   ///< its wheels, which err by GMapping's motion model
  slam,   ///< the wheels, corrected by a particle filter over the lidar's scans
};

struct LocalisationOptions {
  PoseSource source = PoseSource::truth;
  double odometry_noise = 1.0;  ///< multiplies the errors of GMapping's motion model
  LidarOptions lidar = {};
  double lidar_range_m = 4.0;  ///< beams are cropped here
  /// Whom the lidar of slam sees: they hide what is behind them. The seed is theirs, too. Empty:
  /// nobody.
  People people = {};

  /// Throws InputError that names the first bad field with its value.
  void validate() const;
};

/// Distances of the base in the plane from where it was believed to be, m.
struct PositionError {
  double mean_m = 0.0;
  double largest_m = 0.0;
  double end_m = 0.0;  ///< the latest
};

/// How an episode's localisation fared.
struct LocalisationRecord {
  PositionError captures;  ///< at captures, between which and scans the wheels are on their own
  PositionError scans;     ///< right after each scan that slam processed
  std::uint64_t scan_count = 0;
  double scan_ms = 0.0;  ///< computing time of a scan, on average
};

}  // namespace nbvopt
