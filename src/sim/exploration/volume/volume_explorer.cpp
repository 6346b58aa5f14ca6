#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "nbvopt/sim/volume_exploration.hpp"
#include "sim/exploration/drive_region.hpp"
#include "sim/exploration/volume/candidate_poses.hpp"
#include "sim/exploration/volume/frontier_slice.hpp"
#include "sim/exploration/volume/goal_search.hpp"
#include "sim/exploration/volume/rules.hpp"
#include "sim/exploration/volume/view_information.hpp"
#include "sim/exploration/volume/volume_robot.hpp"

namespace nbvopt {
namespace {

constexpr int kTurns = 6;
constexpr double kTurn_rad = std::numbers::pi / 3.0;
constexpr double kGoalTime_s = 120.0;

class VolumeExploration {
 public:
  VolumeExploration(const Scene& scene, const Transform& T_map_base, const Transform& T_base_sensor,
                    const VolumeRules& rules, const ExplorationOptions& options)
      : rules_(rules),
        region_(options),
        robot_(scene, T_map_base, T_base_sensor, rules.camera, options),
        information_(rules.camera),
        random_(options.seed) {}

  /// Explores the plane first, with the camera on.
  void explore_plane(const ExplorationOptions& options) { robot_.explore_plane(options); }

  Exploration run() {
    ExplorationStatus status = ExplorationStatus::time_limit;
    robot_.look();
    for (int i = 0; i < kTurns && !robot_.base().is_out_of_time(); ++i) robot_.turn_by(kTurn_rad);
    while (!robot_.base().is_out_of_time()) {
      std::vector<Eigen::Vector3d> candidates = candidates_around_frontiers();
      if (static_cast<int>(candidates.size()) <= rules_.candidates_at_end) {
        status = leaves_open_ground_ ? ExplorationStatus::open_ground : ExplorationStatus::complete;
        break;
      }
      // What is seen from elsewhere may lead on where no goal could be reached.
      if (!drive_to_the_best(std::move(candidates))) robot_.turn_by(kTurn_rad);
    }
    robot_.stop();
    return {status, robot_.base().trajectory(), robot_.base().grid()};
  }

 private:
  std::vector<Eigen::Vector3d> candidates_around_frontiers() {
    const VoxelGrid& grid = robot_.grid();
    const Transform T_map_base = robot_.base().T_map_base();
    const Eigen::Vector3d slice_map_m =
        T_map_base.translation() + Eigen::Vector3d(0.0, 0.0, rules_.slice_height_m);
    std::vector<Eigen::Vector2d> frontiers_map_m = slice_frontiers(
        grid, robot_.known_box(), grid.lattice().key(slice_map_m).z, rules_.looks_both_ways);
    leaves_open_ground_ = std::erase_if(frontiers_map_m, [&](const Eigen::Vector2d& point) {
                            return region_.is_open_ground(point);
                          }) > 0;
    std::erase_if(frontiers_map_m,
                  [&](const Eigen::Vector2d& point) { return !region_.contains(point); });
    std::vector<Eigen::Vector3d> candidates =
        candidate_poses(grid, group_frontiers(frontiers_map_m, rules_.group_radius_m), T_map_base,
                        robot_.T_base_sensor(), rules_);
    std::erase_if(candidates, [&](const Eigen::Vector3d& pose) {
      return !region_.contains(pose.head<2>()) || region_.is_open_ground(pose.head<2>());
    });
    return candidates;
  }

  /// Drives to the best goal that can be reached in time; false where there is none.
  bool drive_to_the_best(std::vector<Eigen::Vector3d> candidates) {
    const VoxelGrid& grid = robot_.grid();
    const double z_map_m = robot_.base().T_map_base().translation().z();
    const auto information_m3 = [&](const Eigen::Vector3d& pose) {
      return information_.volume_m3(
          grid, base_pose(pose.x(), pose.y(), z_map_m, pose.z()) * robot_.T_base_sensor());
    };
    for (const ScoredPose& goal : best_poses(std::move(candidates), robot_.base().position_map_m(),
                                             rules_, information_m3, random_)) {
      if (robot_.base().is_out_of_time()) return false;
      if (robot_.drive_to(goal.pose, kGoalTime_s) == Arrival::arrived) return true;
    }
    return false;
  }

  VolumeRules rules_;
  DriveRegion region_;
  VolumeRobot robot_;
  ViewInformation information_;
  std::mt19937_64 random_;
  bool leaves_open_ground_ = false;
};

}  // namespace

Exploration explore_volume(const Scene& scene, const Transform& T_map_base,
                           const Transform& T_base_sensor, VolumeExplorer explorer,
                           const ExplorationOptions& options) {
  return VolumeExploration(scene, T_map_base, T_base_sensor, rules_of(explorer), options).run();
}

Exploration explore_volume_after_plane(const Scene& scene, const Transform& T_map_base,
                                       const Transform& T_base_sensor, VolumeExplorer explorer,
                                       const ExplorationOptions& options) {
  VolumeExploration exploration(scene, T_map_base, T_base_sensor, rules_of(explorer), options);
  exploration.explore_plane(options);
  return exploration.run();
}

}  // namespace nbvopt
