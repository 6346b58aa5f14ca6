// What the two forms of the 3D exploration differ in.
#pragma once

#include "nbvopt/sensor/sensor_options.hpp"
#include "nbvopt/sim/volume_exploration.hpp"

namespace nbvopt {

/// Numbers that decide what such an exploration does. Heights are above the floor.
struct VolumeRules {
  /// Planning rays are its horizontal_rays x vertical_rays, frames its pixels.
  SensorOptions camera;
  double slice_height_m;  ///< the layer of voxels around it is searched for frontiers
  bool looks_both_ways;   ///< for frontiers; otherwise towards -x and -y alone
  double group_radius_m;
  int headings;           ///< of the ring of candidates around a group
  double ring_min_m;      ///< the first ring's radius
  double ring_max_m;      ///< the last ring's
  double frontier_gap_m;  ///< from a candidate to any frontier, at least
  double sensor_gap_m;    ///< from a candidate to where the robot is, at least
  bool divides_by_way;    ///< whether a first score is information a metre; otherwise 2 m times it
  double length_scale_m;  ///< of the Gaussian process
  bool wraps_yaw;         ///< whether yaws that differ by a turn are the same to it
  int candidates_at_end;  ///< with so few of them it ends
};

VolumeRules rules_of(VolumeExplorer explorer);

}  // namespace nbvopt
