// The people of a world: where they stand at first, and how they walk.
#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

namespace nbvopt {

/// A place of a scripted walk, in the map, and when it is reached.
struct Waypoint {
  double time_s = 0.0;  ///< after the walk's begin
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;

  bool operator==(const Waypoint&) const = default;
};

/// A walk along waypoints, as an actor's script in SDF has it.
struct ScriptedWalk {
  std::vector<Waypoint> waypoints = {};  ///< one or more; times begin at 0 and grow
  bool is_loop = true;                   ///< begins again when the last waypoint is reached
  double delay_s = 0.0;                  ///< before each round
  bool starts_itself = true;             ///< otherwise it never begins

  bool operator==(const ScriptedWalk&) const = default;
};

/// A walk from target to target around obstacles, as Gazebo's ActorPlugin has it.
struct TargetWalk {
  Eigen::Vector3d target_map_m{0.0, -5.0, 1.2138};  ///< the first one
  double target_weight = 1.15;
  double obstacle_weight = 1.5;
  std::vector<std::string> ignored_models = {};

  bool operator==(const TargetWalk&) const = default;
};

/// Somebody; without a walk, somebody who stands.
struct Person {
  std::string name;
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();  ///< at first
  double yaw_rad = 0.0;
  std::variant<std::monostate, ScriptedWalk, TargetWalk> walk = {};

  bool operator==(const Person&) const = default;
};

/// Where a model of the world has its origin.
struct ModelPlace {
  std::string name;
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();

  bool operator==(const ModelPlace&) const = default;
};

/// Everybody, and what they walk around.
struct People {
  std::vector<Person> persons = {};
  std::vector<ModelPlace> models = {};  ///< none where there is nobody

  bool operator==(const People&) const = default;
};

}  // namespace nbvopt
