#include "sim/exploration/volume/candidate_poses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nbvopt/sim/cell_array.hpp"

namespace nbvopt {
namespace {

constexpr double kRingSpacing_m = 0.5;

/// What is kept clear of occupied voxels around the camera.
const Eigen::Vector3d kRoomBelow_m(0.3, 0.3, 0.1);
const Eigen::Vector3d kRoomAbove_m(0.3, 0.3, 0.3);

/// A ring may be as wide as the gap to frontiers is.
constexpr double kRounding_m = 1e-9;

bool has_room(const VoxelGrid& grid, const Eigen::Vector3d& camera_map_m) {
  const Lattice& lattice = grid.lattice();
  return grid.state(lattice.key(camera_map_m)) != VoxelState::unknown &&
         !grid.any_occupied(
             {lattice.key(camera_map_m - kRoomBelow_m), lattice.key(camera_map_m + kRoomAbove_m)});
}

/// The frontiers of all groups by squares as wide as the gap to them, so that those nearer than it
/// lie in a square or around it.
class FrontierSquares {
 public:
  FrontierSquares(std::span<const FrontierGroup> groups, double gap_m) : gap_m_(gap_m) {
    Eigen::AlignedBox2i box;
    for (const FrontierGroup& group : groups) {
      for (const Eigen::Vector2d& point : group.points_map_m) box.extend(square_at(point));
    }
    if (box.isEmpty()) return;
    points_map_m_.reserve(box);
    for (const FrontierGroup& group : groups) {
      for (const Eigen::Vector2d& point : group.points_map_m) {
        points_map_m_[square_at(point)].push_back(point);
      }
    }
  }

  bool are_clear_of(const Eigen::Vector2d& position_map_m) const {
    const Cell square = square_at(position_map_m);
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const std::vector<Eigen::Vector2d>* near = points_map_m_.find(square + Cell(x, y));
        if (near && std::ranges::any_of(*near, [&](const Eigen::Vector2d& point) {
              return (point - position_map_m).norm() < gap_m_ - kRounding_m;
            })) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  Cell square_at(const Eigen::Vector2d& position_map_m) const {
    return (position_map_m / gap_m_).array().floor().cast<int>();
  }

  double gap_m_;
  CellArray<std::vector<Eigen::Vector2d>> points_map_m_{{}, /*margin=*/0};
};

}  // namespace

std::vector<Eigen::Vector3d> candidate_poses(const VoxelGrid& grid,
                                             std::span<const FrontierGroup> groups,
                                             const Transform& T_map_base,
                                             const Transform& T_base_sensor,
                                             const VolumeRules& rules) {
  const Eigen::Vector3d robot_map_m = T_map_base.translation();
  const double camera_z_map_m = robot_map_m.z() + T_base_sensor.translation().z();
  const Eigen::Vector3d axis_base = T_base_sensor.linear().col(2);
  const double camera_yaw_rad = std::atan2(axis_base.y(), axis_base.x());
  const FrontierSquares frontiers(groups, rules.frontier_gap_m);
  const int rings =
      1 + static_cast<int>(std::lround((rules.ring_max_m - rules.ring_min_m) / kRingSpacing_m));
  std::vector<Eigen::Vector3d> poses;
  for (const FrontierGroup& group : groups) {
    for (int ring = 0; ring < rings; ++ring) {
      for (int heading = 0; heading < rules.headings; ++heading) {
        const double angle_rad = 2.0 * std::numbers::pi * heading / rules.headings;
        const Eigen::Vector2d position_map_m =
            group.points_map_m.front() +
            (rules.ring_min_m + ring * kRingSpacing_m) *
                Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
        if ((position_map_m - robot_map_m.head<2>()).norm() < rules.sensor_gap_m) continue;
        if (!has_room(grid, {position_map_m.x(), position_map_m.y(), camera_z_map_m})) continue;
        if (!frontiers.are_clear_of(position_map_m)) continue;
        poses.emplace_back(position_map_m.x(), position_map_m.y(),
                           wrap_angle(angle_rad + std::numbers::pi - camera_yaw_rad));
      }
    }
  }
  return poses;
}

}  // namespace nbvopt
