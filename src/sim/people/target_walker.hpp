// Walks from target to target around obstacles, as Gazebo's ActorPlugin does.
#pragma once

#include <Eigen/Core>
#include <random>
#include <span>
#include <vector>

#include "nbvopt/sim/people.hpp"
#include "sim/people/walker_pose.hpp"

namespace nbvopt {

/// Somebody who is drawn to a target and pushed away by what is near. Bounds, speed and distances
/// are those that the plugin has built in, Gazebo's cafe.
class TargetWalker {
 public:
  static constexpr double kStep_s = 0.001;     ///< of an update
  static constexpr double kHeight_m = 1.2138;  ///< of a walker's position

  /// `is_heeded` says of each obstacle whether it pushes; targets are drawn with `random`.
  TargetWalker(const TargetWalk& walk, const Person& person, std::vector<bool> is_heeded,
               std::mt19937_64 random);

  /// One update among obstacles, this walker one of them, in the order of `is_heeded`.
  void step(std::span<const Eigen::Vector3d> obstacles_map_m);

  const WalkerPose& pose() const { return pose_; }

 private:
  void choose_target(std::span<const Eigen::Vector3d> obstacles_map_m);
  Eigen::Vector3d push(std::span<const Eigen::Vector3d> obstacles_map_m) const;

  TargetWalk walk_;
  WalkerPose pose_;
  double yaw_rad_;  ///< of Gazebo's skin, which looks a quarter turn to its right
  std::vector<bool> is_heeded_;
  std::mt19937_64 random_;
};

}  // namespace nbvopt
