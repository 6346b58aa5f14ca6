#include "sim/exploration/plane_robot.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/field_check.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/start_check.hpp"
#include "sim/odometry/planar_pose.hpp"
#include "sim/plane_scan.hpp"

namespace nbvopt {
namespace {

constexpr double kStepsPerSecond = 20.0;
constexpr std::size_t kStepsPerScan = 4;
constexpr std::size_t kStepsPerProgress = 20;

/// Where there is room, the base keeps this much farther from walls than it must.
constexpr double kRoom_m = 0.4;

void validate(const ExplorationOptions& options) {
  const auto require_positive = [](const char* field, double value) {
    check_field(value > 0.0, field, value, "positive and finite");
  };
  // Beyond these, grids of the plane would not fit into memory.
  constexpr double kRadiusMax_m = 10.0;
  constexpr double kCellMin_m = 0.01;
  check_field(options.base.radius_m > 0.0 && options.base.radius_m <= kRadiusMax_m, "base.radius_m",
              options.base.radius_m, "positive and at most 10");
  require_positive("base.speed_max_m_s", options.base.speed_max_m_s);
  require_positive("base.turn_rate_max_rad_s", options.base.turn_rate_max_rad_s);
  require_positive("base.acceleration_max_m_s2", options.base.acceleration_max_m_s2);
  require_positive("base.turn_acceleration_max_rad_s2", options.base.turn_acceleration_max_rad_s2);
  check_field(options.cell_m >= kCellMin_m, "cell_m", options.cell_m, "0.01 or more and finite");
  require_positive("duration_max_s", options.duration_max_s);
  options.lidar.validate();
  check_field(options.mapping_range_m > 0.0 && options.mapping_range_m <= options.lidar.range_max_m,
              "mapping_range_m", options.mapping_range_m,
              "positive and at most the lidar's range of " +
                  format_number(options.lidar.range_max_m) + " m");
}

/// The options, once they and the start have been found good, before anything is built on them.
const ExplorationOptions& checked(const Scene& scene, const Transform& T_map_base,
                                  const ExplorationOptions& options) {
  validate(options);
  const Eigen::Vector2d position_map_m = T_map_base.translation().head<2>();
  if (!DriveRegion(options).contains(position_map_m)) {
    throw InputError("the start (" + format_number(position_map_m.x()) + ", " +
                     format_number(position_map_m.y()) + ") lies outside of the region");
  }
  require_free_start(scene, T_map_base, options);
  return options;
}

/// Scans know distances to whole cells, and the base strays from its path by less than one.
double clearance_min_m(const ExplorationOptions& options) {
  return options.base.radius_m + options.cell_m;
}

}  // namespace

PlaneRobot::PlaneRobot(const Scene& scene, const Transform& T_map_base,
                       const ExplorationOptions& options)
    : options_(checked(scene, T_map_base, options)),
      lidar_(scene, options.lidar),
      bystanders_(bystanders_of(scene, options.people, options.seed)),
      z_map_m_(T_map_base.translation().z()),
      grid_(options.cell_m),
      clearance_(options.cell_m, clearance_min_m(options) + kRoom_m),
      motion_(options.base, T_map_base.translation().head<2>(), planar_pose(T_map_base).yaw_rad),
      trajectory_({point(0.0)}) {
  scan();
}

Transform PlaneRobot::T_map_base() const {
  const Eigen::Vector2d& position = motion_.position_map_m();
  return base_pose(position.x(), position.y(), z_map_m_, motion_.yaw_rad());
}

void PlaneRobot::drive_to_next_scan() {
  do {
    step();
  } while (steps() % kStepsPerScan != 0 && !is_out_of_time());
  scan();
}

bool PlaneRobot::is_out_of_time() const {
  return options_.stop.stop_requested() ||
         static_cast<double>(steps() + 1) / kStepsPerSecond > options_.duration_max_s;
}

void PlaneRobot::stop() {
  halt();
  while (!motion_.stands() && !is_out_of_time()) step();
}

void PlaneRobot::step() {
  motion_.step(1.0 / kStepsPerSecond);
  trajectory_.append(point(static_cast<double>(steps() + 1) / kStepsPerSecond));
  if (options_.progress && steps() % kStepsPerProgress == 0) options_.progress(time_s());
}

TrajectoryPoint PlaneRobot::point(double time_s) const {
  const Eigen::Vector2d& position = motion_.position_map_m();
  return {time_s, position.x(), position.y(), z_map_m_, motion_.yaw_rad()};
}

void PlaneRobot::scan() {
  const Transform T_map_base = this->T_map_base();
  std::vector<PlaneBeam> seen = plane_scan(lidar_, T_map_base, options_.mapping_range_m);
  if (bystanders_) {
    bystanders_->move_to(time_s(), [&](double time_s) {
      return Eigen::Vector3d(trajectory_.T_map_base(time_s).translation());
    });
    end_at_people(bystanders_->bodies(), lidar_, T_map_base, seen);
  }
  std::vector<Beam> beams;
  for (const PlaneBeam& beam : seen) {
    const Eigen::Vector3d end_base_m(beam.end_base_m.x(), beam.end_base_m.y(), 0.0);
    beams.push_back({(T_map_base * end_base_m).head<2>(), beam.is_hit});
  }
  clearance_.add_occupied(grid_.insert_scan(position_map_m(), beams));
}

bool PlaneRobot::is_path_blocked(const DriveCosts& costs) const {
  if (!motion_.path()) return false;
  const std::vector<Eigen::Vector2d> rest = motion_.path()->rest(motion_.along_path_m());
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (std::isinf(costs.line_cost_m(rest[i - 1], rest[i]))) return true;
  }
  return false;
}

DriveCosts PlaneRobot::drive_costs(bool through_unknown) const {
  const double clearance_m = clearance_min_m(options_);
  return {grid_, clearance_, {clearance_m, clearance_m + kRoom_m, through_unknown}};
}

}  // namespace nbvopt
