#include "sim/people/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace nbvopt {
namespace {

/// One of somebody's own, so that nobody's targets depend on how often others draw.
std::mt19937_64 generator(std::uint64_t seed, std::size_t number) {
  std::seed_seq seeds{seed, seed >> 32, std::uint64_t{number}};
  return std::mt19937_64(seeds);
}

/// Whether each obstacle pushes that person: all but himself and those that he ignores.
std::vector<bool> heeded(const People& people, std::size_t number, const TargetWalk& walk) {
  const auto is_ignored = [&](const std::string& name) {
    return std::ranges::count(walk.ignored_models, name) > 0;
  };
  std::vector<bool> is_heeded;
  for (const ModelPlace& model : people.models) is_heeded.push_back(!is_ignored(model.name));
  for (std::size_t i = 0; i < people.persons.size(); ++i) {
    is_heeded.push_back(i != number && !is_ignored(people.persons[i].name));
  }
  is_heeded.push_back(true);  // the robot, whose name no world knows
  return is_heeded;
}

WalkerPose start_of(const Person& person) { return {person.position_map_m, person.yaw_rad, 0.0}; }

}  // namespace

Crowd::Crowd(const People& people, std::uint64_t seed) : first_person_(people.models.size()) {
  for (const ModelPlace& model : people.models) obstacles_map_m_.push_back(model.position_map_m);
  for (std::size_t i = 0; i < people.persons.size(); ++i) {
    const Person& person = people.persons[i];
    if (const auto* script = std::get_if<ScriptedWalk>(&person.walk)) {
      walkers_.emplace_back(std::in_place_type<ScriptWalker>, *script, start_of(person));
    } else if (const auto* target = std::get_if<TargetWalk>(&person.walk)) {
      walkers_.emplace_back(std::in_place_type<TargetWalker>, *target, person,
                            heeded(people, i, *target), generator(seed, i));
    } else {
      walkers_.emplace_back(start_of(person));
    }
    poses_.push_back(pose_of(walkers_.back(), 0.0));
    obstacles_map_m_.push_back(poses_.back().position_map_m);
  }
  obstacles_map_m_.emplace_back(Eigen::Vector3d::Zero());  // until the first step
}

void Crowd::walk_until(double time_s, const RobotPosition& robot_map_m) {
  constexpr double kRounding = 1e-6;  // of a step: 0.3 s are 300 of them
  const auto last =
      static_cast<std::int64_t>(std::floor(time_s / TargetWalker::kStep_s + kRounding));
  while (steps_ < last) {
    ++steps_;
    const double now_s = static_cast<double>(steps_) * TargetWalker::kStep_s;
    obstacles_map_m_.back() = robot_map_m(now_s);
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      if (auto* walker = std::get_if<TargetWalker>(&walkers_[i])) walker->step(obstacles_map_m_);
      poses_[i] = pose_of(walkers_[i], now_s);
      obstacles_map_m_[first_person_ + i] = poses_[i].position_map_m;
    }
  }
}

WalkerPose Crowd::pose_of(const Walker& walker, double time_s) {
  if (const auto* script = std::get_if<ScriptWalker>(&walker)) return script->pose(time_s);
  if (const auto* target = std::get_if<TargetWalker>(&walker)) return target->pose();
  return std::get<WalkerPose>(walker);
}

}  // namespace nbvopt
