#include "planner/reach.hpp"

#include <algorithm>
#include <cmath>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// A slip of the unit lies beyond these.
void check_drive(double drive_m, double turn_rad) {
  constexpr double kLongestDrive_m = 100.0;
  constexpr double kLongestTurn_rad = 100.0;
  const auto check = [](double value, double most, const std::string& verb, const char* unit) {
    if (value <= most) return;
    throw InputError("base_twist: the base would " + verb + " " + format_number(std::round(value)) +
                     unit + " while the joints move, at most " + format_number(most) + unit +
                     " can be predicted");
  };
  check(drive_m, kLongestDrive_m, "drive", " m");
  check(turn_rad, kLongestTurn_rad, "turn", " rad");
}

Surroundings sight_of(const MovingMast& mast, const JointBox& box, const SensorOptions& sensor,
                      const Lattice& lattice) {
  const double longest_s = mast.longest_arrival_time_s(box);
  const double drive_m = mast.mast_twist().speed_m_s() * longest_s;
  check_drive(drive_m, std::abs(mast.mast_twist().wz_rad_s) * longest_s);

  // The drive in pieces: no point of a piece is farther from its middle than half its length.
  constexpr double kPiece_m = 0.5;
  const int pieces = std::max(1, static_cast<int>(std::ceil(drive_m / kPiece_m)));
  const double radius_m = mast.mast().options().sensor_offset_m.norm() + sensor.longest_range_m() +
                          lattice.resolution_m() + 0.5 * drive_m / pieces;
  Eigen::AlignedBox3d mast_tops;
  for (int piece = 0; piece < pieces; ++piece) {
    const Transform T_map_mast = mast.T_map_mast(longest_s * (piece + 0.5) / pieces);
    for (const double height_m : {box.min[2], box.max[2]}) {
      mast_tops.extend(T_map_mast * Eigen::Vector3d(0.0, 0.0, height_m));
    }
  }
  return {mast_tops, radius_m};
}

}  // namespace

Reach reach_of(const PlanRequest& request, const Mast& mast, const SensorOptions& sensor,
               const Lattice& lattice) {
  const MovingMast moving = moving_mast(request, mast);
  const JointBox box = mast.reachable_box(request.joints, request.motion_time_s);
  return {moving, box, sight_of(moving, box, sensor, lattice)};
}

JointBox box_free_of_obstacles(const Reach& reach, const VoxelGrid& grid) {
  const MovingMast& mast = reach.mast;
  const JointPosition& joints = mast.joints();
  const auto column_is_occupied = [&](double height_m) {
    JointPosition q = joints;
    q.height_m = height_m;
    return state_at_camera(grid, mast, q) == VoxelState::occupied;
  };
  JointBox box = reach.joints;
  if (column_is_occupied(joints.height_m)) {
    box.min[2] = box.max[2] = joints.height_m;
    return box;
  }
  // Half voxels along the way of the optical centre, as far as it moves through no obstacle. A
  // moving base lengthens the way.
  const double way_per_height =
      1.0 + mast.mast_twist().speed_m_s() / mast.mast().options().height_velocity_m_s;
  const double step_m = 0.5 * grid.lattice().resolution_m() / way_per_height;
  const auto free_until = [&](double limit_m, double direction) {
    double free_m = joints.height_m;
    for (int i = 1; direction * (limit_m - free_m) > 0.0; ++i) {
      const double next_m = joints.height_m + direction * i * step_m;
      const double height_m = direction * (limit_m - next_m) > 0.0 ? next_m : limit_m;
      if (column_is_occupied(height_m)) return free_m;
      free_m = height_m;
    }
    return limit_m;
  };
  box.max[2] = free_until(box.max[2], 1.0);
  box.min[2] = free_until(box.min[2], -1.0);
  return box;
}

VoxelState state_at_camera(const VoxelGrid& grid, const MovingMast& mast,
                           const JointPosition& joints) {
  return grid.state(grid.lattice().key(mast.T_map_sensor(joints).translation()));
}

}  // namespace nbvopt
