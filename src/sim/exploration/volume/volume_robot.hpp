// A base with a lidar and a camera that maps space as it drives.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "sim/exploration/plane_robot.hpp"
#include "sim/exploration/reach.hpp"

namespace nbvopt {

/// A PlaneRobot whose camera, which stands still on it, takes a frame a second into an octree of
/// 0.05 m.
class VolumeRobot {
 public:
  /// Stands at the start, has scanned once and has not looked yet. Throws InputError as explore()
  /// does, and when the options of the camera are bad.
  VolumeRobot(const Scene& scene, const Transform& T_map_base, const Transform& T_base_sensor,
              const SensorOptions& camera, const ExplorationOptions& options);

  /// Takes a frame from where it is.
  void look();

  /// Explores the plane first, as explore() does.
  void explore_plane(const ExplorationOptions& options);

  /// Turns on the spot by an angle, braking first where it drives.
  void turn_by(double angle_rad);

  /// Drives to a pose (x, y, yaw in the map), for so long at most.
  Arrival drive_to(const Eigen::Vector3d& pose, double time_max_s);

  const PlaneRobot& base() const { return base_; }
  void stop() { base_.stop(); }

  Transform T_base_sensor() const { return T_base_sensor_; }

  /// What all frames so far have shown.
  const VoxelGrid& grid();

  /// The smallest box that holds all that is known. There is something known.
  KeyBox known_box() const { return *tree_.known_box(); }

 private:
  void on_scan();
  /// Turns to a yaw, which is not wrapped, until then at most.
  Arrival turn_to(double yaw_rad, double until_s);

  PlaneRobot base_;
  DriveCosts costs_;
  Transform T_base_sensor_;
  SimulatedCamera camera_;
  SensorOptions sensor_;
  UncertaintyMap tree_;
  std::shared_ptr<const VoxelGrid> grid_;
  std::vector<VoxelChange> changes_;  ///< of the tree that the grid lacks
  std::uint64_t frames_ = 0;
  int scans_ = 0;
};

}  // namespace nbvopt
