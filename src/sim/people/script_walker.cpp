#include "sim/people/script_walker.hpp"

#include <algorithm>
#include <cmath>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

ScriptWalker::ScriptWalker(const ScriptedWalk& walk, const WalkerPose& start)
    : walk_(walk), start_(start) {
  double walked_m = 0.0;
  const Waypoint* last = nullptr;
  for (const Waypoint& waypoint : walk_.waypoints) {
    if (last != nullptr) walked_m += (waypoint.position_map_m - last->position_map_m).norm();
    walked_m_.push_back(walked_m);
    last = &waypoint;
  }
}

WalkerPose ScriptWalker::pose(double time_s) const {
  if (!walk_.starts_itself || time_s < walk_.delay_s) return start_;
  const double duration_s = walk_.waypoints.back().time_s;
  const double round_s = walk_.delay_s + duration_s;
  double rounds = 0.0;
  if (walk_.is_loop && round_s > 0.0) rounds = std::floor(time_s / round_s);
  const double into_round_s = time_s - rounds * round_s - walk_.delay_s;
  if (into_round_s < 0.0) rounds -= 1.0;  // the delay before a later round
  WalkerPose pose = pose_in_round(into_round_s < 0.0 ? duration_s : into_round_s);
  pose.walked_m += rounds * walked_m_.back();
  return pose;
}

WalkerPose ScriptWalker::pose_in_round(double time_s) const {
  const std::vector<Waypoint>& waypoints = walk_.waypoints;
  const auto after = std::ranges::upper_bound(waypoints, time_s, {}, &Waypoint::time_s);
  if (after == waypoints.end()) {
    return {waypoints.back().position_map_m, waypoints.back().yaw_rad, walked_m_.back()};
  }
  const auto index = static_cast<std::size_t>(after - waypoints.begin());
  const Waypoint& last = waypoints[index - 1];
  const double part = (time_s - last.time_s) / (after->time_s - last.time_s);
  return {last.position_map_m + part * (after->position_map_m - last.position_map_m),
          last.yaw_rad + part * wrap_angle(after->yaw_rad - last.yaw_rad),
          walked_m_[index - 1] + part * (walked_m_[index] - walked_m_[index - 1])};
}

}  // namespace nbvopt
