// Where somebody is.
#pragma once

#include <Eigen/Core>

namespace nbvopt {

/// Somebody on the way. The position is that of the world's file, at about the hips in Gazebo's
/// worlds.
struct WalkerPose {
  Eigen::Vector3d position_map_m = Eigen::Vector3d::Zero();
  double heading_rad = 0.0;  ///< in which the legs swing
  double walked_m = 0.0;     ///< so far
};

}  // namespace nbvopt
