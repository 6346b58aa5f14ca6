// A base with a lidar that drives through a scene and maps it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "nbvopt/sim/exploration.hpp"
#include "sim/exploration/base_motion.hpp"
#include "sim/exploration/clearance_field.hpp"
#include "sim/exploration/drive_costs.hpp"
#include "sim/people/bystanders.hpp"

namespace nbvopt {

/// The robot in simulated time: steps of 0.05 s, a scan every 0.2 s.
class PlaneRobot {
 public:
  /// Stands at the start and has scanned once. Throws InputError as explore() does.
  PlaneRobot(const Scene& scene, const Transform& T_map_base, const ExplorationOptions& options);

  /// Moves on to the next scan and takes it, or to the end of the time.
  void drive_to_next_scan();

  bool is_out_of_time() const;

  /// Brakes until the base stands.
  void stop();

  void follow(Path path) { motion_.follow(std::move(path)); }
  void halt() { motion_.halt(); }
  bool has_arrived() const { return motion_.has_arrived(); }

  /// As BaseMotion's.
  void turn_to(double yaw_rad) { motion_.turn_to(yaw_rad); }
  bool has_turned() const { return motion_.has_turned(); }
  bool stands() const { return motion_.stands(); }

  /// Whether what the lidar has seen since bars the rest of the way.
  bool is_path_blocked(const DriveCosts& costs) const;

  double time_s() const { return trajectory_.duration_s(); }
  Transform T_map_base() const;
  const Eigen::Vector2d& position_map_m() const { return motion_.position_map_m(); }
  double yaw_rad() const { return motion_.yaw_rad(); }  ///< not wrapped
  const OccupancyGrid& grid() const { return grid_; }

  /// What ways cost this base, through known free cells only or unknown ones too. It refers to this
  /// robot.
  DriveCosts drive_costs(bool through_unknown) const;

  const Trajectory& trajectory() const { return trajectory_; }

 private:
  void step();
  void scan();
  std::size_t steps() const { return trajectory_.points().size() - 1; }
  TrajectoryPoint point(double time_s) const;

  ExplorationOptions options_;
  SimulatedLidar lidar_;
  std::optional<Bystanders> bystanders_;  ///< whom it sees
  double z_map_m_;
  OccupancyGrid grid_;
  ClearanceField clearance_;
  BaseMotion motion_;
  Trajectory trajectory_;
};

}  // namespace nbvopt
