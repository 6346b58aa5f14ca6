// Where a base may want to go.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "nbvopt/sim/exploration.hpp"

namespace nbvopt {

/// The region of ExplorationOptions, and what is open ground.
class DriveRegion {
 public:
  /// Throws InputError when the region has one or two corners, or one that is not finite.
  explicit DriveRegion(const ExplorationOptions& options);

  /// Whether it lies in the region; everything does when there is none.
  bool contains(const Eigen::Vector2d& position_map_m) const;

  /// Whether it lies beyond all that there is to see; nothing does when a region is given.
  bool is_open_ground(const Eigen::Vector2d& position_map_m) const;

 private:
  std::vector<Eigen::Vector2d> corners_map_m_;
  Eigen::AlignedBox2d near_world_map_m_;
};

}  // namespace nbvopt
