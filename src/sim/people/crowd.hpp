// Everybody in a world, on their ways.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "nbvopt/sim/people.hpp"
#include "sim/people/script_walker.hpp"
#include "sim/people/target_walker.hpp"
#include "sim/people/walker_pose.hpp"

namespace nbvopt {

/// Where the robot's base is in the map at a time.
using RobotPosition = std::function<Eigen::Vector3d(double time_s)>;

/// The walkers of a world. Where they are depends on the time, the seed and the robot's way, and
/// not on the times at which anybody asks: they move in steps of a millisecond, one after the other
/// in the order of the file, as Gazebo updates them.
class Crowd {
 public:
  Crowd(const People& people, std::uint64_t seed);

  /// Walks on until that time, which is not before the last one. The robot is asked for its
  /// position at times up to then.
  void walk_until(double time_s, const RobotPosition& robot_map_m);

  /// In the order of People::persons.
  std::span<const WalkerPose> poses() const { return poses_; }

 private:
  using Walker = std::variant<WalkerPose, ScriptWalker, TargetWalker>;

  static WalkerPose pose_of(const Walker& walker, double time_s);

  std::vector<Walker> walkers_;
  std::vector<WalkerPose> poses_;
  /// Models, then people, then the robot.
  std::vector<Eigen::Vector3d> obstacles_map_m_;
  std::size_t first_person_ = 0;  ///< among the obstacles
  std::int64_t steps_ = 0;        ///< walked so far
};

}  // namespace nbvopt
