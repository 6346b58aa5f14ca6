// Simultaneous localisation and mapping along a drive.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nbvopt/sim/localisation.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "sim/odometry/odometry.hpp"
#include "sim/odometry/position_errors.hpp"
#include "sim/people/bystanders.hpp"
#include "sim/plane_scan.hpp"
#include "sim/slam/particle_filter.hpp"

namespace nbvopt {

/// Follows a drive with a lidar and corrects the wheels, as slam_gmapping does for ROS. Scans enter
/// the particles' maps as rarely as there; whoever asks for a pose between two of them gets that of
/// a scan taken then, where it fits into the best particle's map.
class Slam {
 public:
  /// Throws InputError when the lidar sees nothing from the start, and as Bystanders does. All must
  /// outlive this.
  Slam(const Scene& scene, const Trajectory& trajectory, const Odometry& odometry,
       const LocalisationOptions& options, std::uint64_t seed);

  /// As believed then. Times must not go back.
  PlanarPose T_map_base(double time_s);

  std::uint64_t scan_count() const { return scans_; }    ///< entered so far, without the first
  double computing_ms() const { return computing_ms_; }  ///< that they took, all in all
  const PositionError& errors() const { return errors_.summary(); }  ///< right after them

 private:
  /// What the lidar sees then; times must not go back.
  std::vector<PlaneBeam> scan(double time_s);
  std::vector<PlaneBeam> first_scan();

  const Trajectory& trajectory_;
  const Odometry& odometry_;
  SimulatedLidar lidar_;
  double lidar_range_m_;
  std::optional<Bystanders> bystanders_;  ///< whom it sees
  ParticleFilter filter_;
  std::size_t scans_ = 0;
  PositionErrors errors_;
  double computing_ms_ = 0.0;
  /// The latest pose that was believed in, and what the wheels told then.
  PlanarPose T_map_base_;
  PlanarPose T_odom_base_;
};

}  // namespace nbvopt
