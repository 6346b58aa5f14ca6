#include "sim/exploration/volume/volume_robot.hpp"

#include <limits>

#include "nbvopt/map/scan.hpp"
#include "sim/exploration/plane_explorer.hpp"

namespace nbvopt {
namespace {

constexpr double kVoxel_m = 0.05;
constexpr int kScansPerFrame = 5;
constexpr double kNoHurry_s = std::numeric_limits<double>::infinity();

}  // namespace

VolumeRobot::VolumeRobot(const Scene& scene, const Transform& T_map_base,
                         const Transform& T_base_sensor, const SensorOptions& camera,
                         const ExplorationOptions& options)
    : base_(scene, T_map_base, options),
      costs_(base_.drive_costs(/*through_unknown=*/true)),
      T_base_sensor_(T_base_sensor),
      camera_(scene, camera, /*range_noise_m=*/0.0, options.seed),
      sensor_(camera),
      tree_(kVoxel_m),
      grid_(VoxelGrid::whole(tree_)) {}

void VolumeRobot::look() {
  const Transform T_map_sensor = base_.T_map_base() * T_base_sensor_;
  const InsertResult inserted =
      insert_scan(tree_, camera_.capture(T_map_sensor, frames_++), T_map_sensor, sensor_);
  changes_.insert(changes_.end(), inserted.changes.begin(), inserted.changes.end());
}

const VoxelGrid& VolumeRobot::grid() {
  if (!changes_.empty()) grid_ = grid_->updated(changes_);
  changes_.clear();
  return *grid_;
}

void VolumeRobot::explore_plane(const ExplorationOptions& options) {
  nbvopt::explore_plane(base_, options, [this] { on_scan(); });
}

void VolumeRobot::on_scan() {
  if (++scans_ % kScansPerFrame == 0) look();
}

Arrival VolumeRobot::turn_to(double yaw_rad, double until_s) {
  base_.turn_to(yaw_rad);
  while (!base_.has_turned() || !base_.stands()) {
    if (base_.time_s() >= until_s || base_.is_out_of_time()) return Arrival::late;
    base_.drive_to_next_scan();
    on_scan();
  }
  return Arrival::arrived;
}

void VolumeRobot::turn_by(double angle_rad) {
  turn_to(base_.yaw_rad() + angle_rad, kNoHurry_s);
  look();
}

Arrival VolumeRobot::drive_to(const Eigen::Vector3d& pose, double time_max_s) {
  const double until_s = base_.time_s() + time_max_s;
  if (!costs_.is_passable(base_.grid().cell_at(pose.head<2>()))) return Arrival::barred;
  Arrival arrival = reach(base_, costs_, pose.head<2>(), until_s, [this] { on_scan(); });
  if (arrival == Arrival::arrived) {
    arrival = turn_to(base_.yaw_rad() + wrap_angle(pose.z() - base_.yaw_rad()), until_s);
  }
  look();
  return arrival;
}

}  // namespace nbvopt
