#include "sim/slam/slam.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
Slam::Slam(const Scene& scene, const Trajectory& trajectory, const Odometry& odometry,
           const LocalisationOptions& options, std::uint64_t seed)
    : trajectory_(trajectory),
      odometry_(odometry),
      lidar_(scene, options.lidar),
      lidar_range_m_(options.lidar_range_m),
      bystanders_(bystanders_of(scene, options.people, seed)),
      filter_(MotionModel(options.odometry_noise), odometry.steps().front().T_world_base,
              first_scan(), seed),
      T_map_base_(filter_.T_map_base()),
      T_odom_base_(odometry.steps().front().T_odom_base) {}

std::vector<PlaneBeam> Slam::scan(double time_s) {
  const Transform T_world_base = trajectory_.T_map_base(time_s);
  std::vector<PlaneBeam> beams = plane_scan(lidar_, T_world_base, lidar_range_m_);
  if (bystanders_) {
    bystanders_->move_to(time_s, [&](double earlier_s) {
      return Eigen::Vector3d(trajectory_.T_map_base(earlier_s).translation());
    });
    end_at_people(bystanders_->bodies(), lidar_, T_world_base, beams);
  }
  return beams;
}

std::vector<PlaneBeam> Slam::first_scan() {
  std::vector<PlaneBeam> beams = scan(0.0);
  if (std::ranges::any_of(beams, &PlaneBeam::is_hit)) return beams;
  throw InputError("slam: the lidar sees nothing within " + format_number(lidar_range_m_) +
                   " m of where the drive starts, so that there is nothing to go by: start near "
                   "walls, or use the pose source odom or truth");
}

PlanarPose Slam::T_map_base(double time_s) {
  const std::span<const DriveStep> steps = odometry_.steps();
  while (scans_ + 1 < steps.size() && steps[scans_ + 1].begin_s <= time_s) {
    const DriveStep& before = steps[scans_++];
    const DriveStep& now = steps[scans_];
    const std::vector<PlaneBeam> seen = scan(now.begin_s);
    const Stopwatch stopwatch;
    filter_.update(inverse(before.T_odom_base) * now.T_odom_base, seen);
    computing_ms_ += stopwatch.elapsed_ms();
    const PlanarPose error = inverse(now.T_world_base) * filter_.T_map_base();
    errors_.add(std::hypot(error.x_m, error.y_m));
    T_map_base_ = filter_.T_map_base();
    T_odom_base_ = now.T_odom_base;
  }
  if (time_s > steps[scans_].begin_s) {
    const PlanarPose T_odom_base = odometry_.T_odom_base(time_s);
    T_map_base_ = filter_.fit(T_map_base_ * inverse(T_odom_base_) * T_odom_base, scan(time_s));
    T_odom_base_ = T_odom_base;
  }
  return T_map_base_;
}

}  // namespace nbvopt
