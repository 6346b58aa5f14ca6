#include "sim/exploration/base_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nbvopt {
namespace {

/// How far ahead on its path the base aims: far enough to round corners, and so near that it keeps
/// to the path within half a cell or so.
constexpr double kLookAhead_m = 0.1;
/// The part of the path on which the base looks for itself.
constexpr double kSearchAhead_m = 0.5;
constexpr double kArrival_m = 0.03;
constexpr double kTurned_rad = 0.005;

}  // namespace

double braking_speed(double distance_m, double acceleration_m_s2, double time_step_s) {
  // From speed v, n steps that are each slower by a dt cover n v dt - a dt^2 n (n - 1) / 2.
  const double slowdown_m_s = acceleration_m_s2 * time_step_s;
  const double steps =
      std::ceil(std::sqrt(0.25 + 2.0 * distance_m / (slowdown_m_s * time_step_s)) - 0.5);
  if (steps < 1.0) return 0.0;
  return distance_m / (steps * time_step_s) + 0.5 * slowdown_m_s * (steps - 1.0);
}

BaseMotion::BaseMotion(const BaseOptions& options, const Eigen::Vector2d& position_map_m,
                       double yaw_rad)
    : options_(options), position_map_m_(position_map_m), yaw_rad_(yaw_rad) {}

void BaseMotion::follow(Path path) {
  turn_to_rad_.reset();
  path_ = std::move(path);
  along_path_m_ = 0.0;
}

void BaseMotion::turn_to(double yaw_rad) {
  path_.reset();
  turn_to_rad_ = yaw_rad;
}

void BaseMotion::halt() {
  path_.reset();
  turn_to_rad_.reset();
}

bool BaseMotion::has_arrived() const {
  return !path_ || (path_->point_at(path_->length_m()) - position_map_m_).norm() < kArrival_m;
}

bool BaseMotion::has_turned() const {
  return !turn_to_rad_ || std::abs(*turn_to_rad_ - yaw_rad_) < kTurned_rad;
}

bool BaseMotion::stands() const { return velocity_map_m_s_.isZero(0.0) && turn_rate_rad_s_ == 0.0; }

void BaseMotion::step(double time_s) {
  const auto turn_rate = [&](double turn_rad) {
    return std::copysign(
        std::min(options_.turn_rate_max_rad_s,
                 braking_speed(std::abs(turn_rad), options_.turn_acceleration_max_rad_s2, time_s)),
        turn_rad);
  };
  Eigen::Vector2d wanted_m_s = Eigen::Vector2d::Zero();
  double wanted_rad_s = turn_to_rad_ ? turn_rate(*turn_to_rad_ - yaw_rad_) : 0.0;
  if (path_ && !has_arrived()) {
    along_path_m_ =
        path_->nearest_m(position_map_m_, along_path_m_, along_path_m_ + kSearchAhead_m);
    const Eigen::Vector2d ahead_m = path_->point_at(along_path_m_ + kLookAhead_m) - position_map_m_;
    const double left_m = std::max(ahead_m.norm(), path_->length_m() - along_path_m_);
    const double turn_rad = wrap_angle(std::atan2(ahead_m.y(), ahead_m.x()) - yaw_rad_);
    const double speed_m_s =
        std::min(options_.speed_max_m_s * std::clamp(2.0 * std::cos(turn_rad), 0.0, 1.0),
                 braking_speed(left_m, options_.acceleration_max_m_s2, time_s));
    wanted_m_s = speed_m_s * ahead_m.normalized();
    wanted_rad_s = turn_rate(turn_rad);
  }
  const Eigen::Vector2d change_m_s = wanted_m_s - velocity_map_m_s_;
  const double change_max_m_s = options_.acceleration_max_m_s2 * time_s;
  velocity_map_m_s_ = change_m_s.norm() <= change_max_m_s
                          ? wanted_m_s
                          : velocity_map_m_s_ + change_max_m_s * change_m_s.normalized();
  const double turn_change_max_rad_s = options_.turn_acceleration_max_rad_s2 * time_s;
  turn_rate_rad_s_ +=
      std::clamp(wanted_rad_s - turn_rate_rad_s_, -turn_change_max_rad_s, turn_change_max_rad_s);
  position_map_m_ += velocity_map_m_s_ * time_s;
  yaw_rad_ += turn_rate_rad_s_ * time_s;
}

}  // namespace nbvopt
