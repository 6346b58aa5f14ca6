// What people look like.
#pragma once

#include <Eigen/Core>
#include <array>

namespace nbvopt {

/// The points within a radius of a line.
struct Capsule {
  Eigen::Vector3d from_m;
  Eigen::Vector3d to_m;
  double radius_m;
};

inline constexpr double kBodyRadius_m = 0.25;
inline constexpr double kBodyHeight_m = 1.7;

/// Somebody who has walked so far, in a frame between his feet, x ahead: a capsule from the floor
/// up, and two legs that swing about the hips and stick out of it.
std::array<Capsule, 3> body_parts(double walked_m);

}  // namespace nbvopt
