#include "sim/people/target_walker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/uniform.hpp"
#include "nbvopt/core/transform.hpp"

namespace nbvopt {
namespace {

constexpr double kSpeed_m_s = 0.8;  ///< where the pull is 1
const Eigen::Vector2d kLeast_m(-3.0, -10.0);
const Eigen::Vector2d kMost_m(3.5, 2.0);
constexpr double kReached_m = 0.3;
constexpr double kTargetDistance_m = 2.0;  ///< least, of a new target from the old and all models
constexpr double kHeeded_m = 4.0;          ///< farther obstacles do not push
constexpr double kSkinTurn_rad = 1.5707;   ///< as many digits as the plugin has
constexpr double kTurnOnTheSpot_rad = 10.0 * std::numbers::pi / 180.0;
constexpr double kTurnAnUpdate = 0.001;  ///< of what is left to turn

/// The plugin seeks without end where there is no place.
constexpr int kDraws = 1000;

double drawn(std::mt19937_64& random, double least, double most) {
  return least + uniform(random) * (most - least);
}

}  // namespace

TargetWalker::TargetWalker(const TargetWalk& walk, const Person& person,
                           std::vector<bool> is_heeded, std::mt19937_64 random)
    : walk_(walk),
      pose_{person.position_map_m, person.yaw_rad - kSkinTurn_rad, 0.0},
      yaw_rad_(person.yaw_rad),
      is_heeded_(std::move(is_heeded)),
      random_(random) {}

void TargetWalker::step(std::span<const Eigen::Vector3d> obstacles_map_m) {
  Eigen::Vector3d& position = pose_.position_map_m;
  if ((walk_.target_map_m - position).norm() < kReached_m) choose_target(obstacles_map_m);
  const Eigen::Vector3d pull =
      walk_.target_weight * (walk_.target_map_m - position).normalized() - push(obstacles_map_m);
  const double turn_rad = wrap_angle(std::atan2(pull.y(), pull.x()) + kSkinTurn_rad - yaw_rad_);
  const Eigen::Vector3d before = position;
  if (std::abs(turn_rad) > kTurnOnTheSpot_rad) {
    yaw_rad_ += kTurnAnUpdate * turn_rad;
  } else {
    position += kSpeed_m_s * kStep_s * pull;
    yaw_rad_ += turn_rad;
  }
  position.head<2>() = position.head<2>().cwiseMax(kLeast_m).cwiseMin(kMost_m);
  position.z() = kHeight_m;
  pose_.heading_rad = yaw_rad_ - kSkinTurn_rad;
  pose_.walked_m += (position - before).head<2>().norm();
}

void TargetWalker::choose_target(std::span<const Eigen::Vector3d> obstacles_map_m) {
  const Eigen::Vector3d last = walk_.target_map_m;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::Vector3d target = last;
    target.x() = drawn(random_, kLeast_m.x(), kMost_m.x());
    target.y() = drawn(random_, kLeast_m.y(), kMost_m.y());
    const auto is_far = [&](const Eigen::Vector3d& other) {
      return (target - other).norm() >= kTargetDistance_m;
    };
    if (!is_far(last) || !std::ranges::all_of(obstacles_map_m, is_far)) continue;
    walk_.target_map_m = target;
    return;
  }
}

Eigen::Vector3d TargetWalker::push(std::span<const Eigen::Vector3d> obstacles_map_m) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < obstacles_map_m.size(); ++i) {
    if (!is_heeded_[i]) continue;
    const Eigen::Vector3d offset = obstacles_map_m[i] - pose_.position_map_m;
    const double distance_m = offset.norm();
    if (distance_m > 0.0 && distance_m < kHeeded_m) {
      sum += walk_.obstacle_weight / (distance_m * distance_m) * offset;
    }
  }
  return sum;
}

}  // namespace nbvopt
