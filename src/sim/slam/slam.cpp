#include "sim/slam/slam.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// The scan that maps begin with.
std::vector<PlaneBeam> first_scan(const SimulatedLidar& lidar, const Transform& T_world_base,
                                  double range_m) {
  std::vector<PlaneBeam> scan = plane_scan(lidar, T_world_base, range_m);
  if (std::ranges::any_of(scan, &PlaneBeam::is_hit)) return scan;
  throw InputError("slam: the lidar sees nothing within " + format_number(range_m) +
                   " m of where the drive starts, so that there is nothing to go by: start near "
                   "walls, or use the pose source odom or truth");
}

}  // namespace

Slam::Slam(const Scene& scene, const Trajectory& trajectory, const Odometry& odometry,
           const LocalisationOptions& options, std::uint64_t seed)
    : trajectory_(trajectory),
      odometry_(odometry),
      lidar_(scene, options.lidar),
      lidar_range_m_(options.lidar_range_m),
      filter_(MotionModel(options.odometry_noise), odometry.steps().front().T_world_base,
              first_scan(lidar_, trajectory.T_map_base(0.0), options.lidar_range_m), seed) {}

PlanarPose Slam::T_map_odom(double time_s) {
  const std::span<const DriveStep> steps = odometry_.steps();
  while (scans_ + 1 < steps.size() && steps[scans_ + 1].begin_s <= time_s) {
    const DriveStep& before = steps[scans_++];
    const DriveStep& now = steps[scans_];
    const std::vector<PlaneBeam> scan =
        plane_scan(lidar_, trajectory_.T_map_base(now.begin_s), lidar_range_m_);
    const Stopwatch stopwatch;
    filter_.update(inverse(before.T_odom_base) * now.T_odom_base, scan);
    computing_ms_ += stopwatch.elapsed_ms();
    const PlanarPose error = inverse(now.T_world_base) * filter_.T_map_base();
    errors_.add(std::hypot(error.x_m, error.y_m));
    T_map_odom_ = filter_.T_map_base() * inverse(now.T_odom_base);
  }
  return T_map_odom_;
}

}  // namespace nbvopt
