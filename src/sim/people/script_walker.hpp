// Walks along waypoints.
#pragma once

#include <vector>

#include "nbvopt/sim/people.hpp"
#include "sim/people/walker_pose.hpp"

namespace nbvopt {

/// Where a script has somebody at any time: between waypoints, in time, where position and yaw (the
/// short way round) are linear. Before the first round, and always where it does not begin by
/// itself, he stands where the world has him; between rounds and after the last at the last
/// waypoint.
class ScriptWalker {
 public:
  ScriptWalker(const ScriptedWalk& walk, const WalkerPose& start);

  WalkerPose pose(double time_s) const;

 private:
  WalkerPose pose_in_round(double time_s) const;

  ScriptedWalk walk_;
  WalkerPose start_;
  std::vector<double> walked_m_;  ///< in a round, at each waypoint
};

}  // namespace nbvopt
