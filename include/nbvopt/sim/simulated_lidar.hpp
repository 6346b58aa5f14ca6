// A planar lidar that sees a scene.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// The default is the paper's: 360 degrees in steps of half a degree, 100 m.
struct LidarOptions {
  int beams = 720;  ///< over the full turn, the first along the base's x axis
  double range_min_m = 0.12;
  double range_max_m = 100.0;
  double height_m = 0.182;  ///< above the base

  /// Throws InputError that names the first bad field with its value.
  void validate() const;
};

/// Scans the plane of the base at the lidar's height.
class SimulatedLidar {
 public:
  /// Throws InputError as LidarOptions::validate() does. The scene must outlive the lidar.
  SimulatedLidar(const Scene& scene, const LidarOptions& options);

  const LidarOptions& options() const { return options_; }

  /// The angle of a beam in the base frame, counter-clockwise from its x axis, rad.
  double angle_rad(int beam) const;

  /// One range a beam: +inf where nothing is in range, -inf where something is nearer than
  /// range_min_m, as drivers give it (ROS REP 117).
  std::vector<float> scan(const Transform& T_map_base) const;

 private:
  const Scene& scene_;
  LidarOptions options_;
};

}  // namespace nbvopt
