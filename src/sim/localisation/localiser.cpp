#include "sim/localisation/localiser.hpp"

#include "core/field_check.hpp"
#include "sim/odometry/odometry.hpp"
#include "sim/slam/slam.hpp"

namespace nbvopt {

void LocalisationOptions::validate() const {
  check_field(odometry_noise >= 0.0, "odometry_noise", odometry_noise, "0 or more and finite");
  lidar.validate();
  check_field(
      lidar_range_m > 0.0 && lidar_range_m <= lidar.range_max_m, "lidar_range_m", lidar_range_m,
      "positive and at most the lidar's range of " + format_number(lidar.range_max_m) + " m");
}

Localiser::Localiser(const Scene& scene, const Trajectory& trajectory,
                     const LocalisationOptions& options, std::uint64_t seed)
    : trajectory_(trajectory) {
  options.validate();
  if (options.source == PoseSource::truth) return;
  odometry_ = std::make_unique<Odometry>(trajectory, MotionModel(options.odometry_noise), seed);
  if (options.source == PoseSource::odom) return;
  slam_ = std::make_unique<Slam>(scene, trajectory, *odometry_, options, seed);
}

Localiser::~Localiser() = default;

BasePoses Localiser::at(double time_s) {
  const Transform T_world_base = trajectory_.T_map_base(time_s);
  latest_ = {T_world_base, T_world_base};
  if (!odometry_) return latest_;
  const PlanarPose believed = slam_ ? slam_->T_map_base(time_s) : odometry_->T_odom_base(time_s);
  latest_.T_map_base =
      base_pose(believed.x_m, believed.y_m, T_world_base.translation().z(), believed.yaw_rad);
  errors_.add((latest_.T_map_base.translation() - T_world_base.translation()).norm());
  return latest_;
}

BasePoses Localiser::ahead(double time_s) const {
  const Transform T_world_base = trajectory_.T_map_base(time_s);
  if (!odometry_) return {T_world_base, T_world_base};
  return {latest_.T_map_base * latest_.T_world_base.inverse() * T_world_base, T_world_base};
}

LocalisationRecord Localiser::record() const {
  LocalisationRecord record{.captures = errors_.summary(), .scans = {}};
  if (slam_ && slam_->scan_count() > 0) {
    record.scans = slam_->errors();
    record.scan_count = slam_->scan_count();
    record.scan_ms = slam_->computing_ms() / static_cast<double>(slam_->scan_count());
  }
  return record;
}

}  // namespace nbvopt
