#include "sim/odometry/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace nbvopt {
namespace {

constexpr double kScanPeriod_s = 0.2;

// slam_gmapping's linearUpdate and angularUpdate, and a time after which it need not have moved.
constexpr double kStepLength_m = 1.0;
constexpr double kStepTurn_rad = 0.5;
constexpr double kStepTime_s = 2.0;

constexpr double kTimeTolerance_s = 1e-9;

}  // namespace

Odometry::Odometry(const Trajectory& trajectory, const MotionModel& model, std::uint64_t seed)
    : trajectory_(trajectory), model_(model) {
  std::seed_seq seeds{seed, seed >> 32, std::uint64_t{0x0d0}};
  std::mt19937_64 generator(seeds);
  const PlanarPose start = planar_pose(trajectory.T_map_base(0.0));
  steps_.push_back({0.0, start, start, MotionModel::draw_normals(generator)});
  // Multiples of the period, since the errors of a sum would grow.
  for (int scan = 1; scan * kScanPeriod_s <= trajectory.duration_s(); ++scan) {
    const double time_s = scan * kScanPeriod_s;
    const PlanarPose T_world_base = planar_pose(trajectory.T_map_base(time_s));
    const DriveStep& step = steps_.back();
    const PlanarPose motion = inverse(step.T_world_base) * T_world_base;
    if (std::hypot(motion.x_m, motion.y_m) < kStepLength_m &&
        std::abs(motion.yaw_rad) < kStepTurn_rad &&
        time_s - step.begin_s < kStepTime_s - kTimeTolerance_s) {
      continue;
    }
    const PlanarPose T_odom_base = step.T_odom_base * model_.erring(motion, step.normals);
    steps_.push_back({time_s, T_world_base, T_odom_base, MotionModel::draw_normals(generator)});
  }
}

PlanarPose Odometry::T_odom_base(double time_s) const {
  const auto after = std::ranges::upper_bound(steps_, time_s, {}, &DriveStep::begin_s);
  const DriveStep& step = after == steps_.begin() ? steps_.front() : *(after - 1);
  const PlanarPose T_world_base = planar_pose(trajectory_.T_map_base(time_s));
  return step.T_odom_base * model_.erring(inverse(step.T_world_base) * T_world_base, step.normals);
}

}  // namespace nbvopt
