// Where the rays of a cone are, as intervals along its axes. In voxels.
#pragma once

#include <algorithm>
#include <limits>

namespace nbvopt::detail {

/// Casters walk in single precision, and so may be in a voxel that the ray just misses.
constexpr double kConeRounding = 1e-3;

/// A closed interval.
struct ConeSpan {
  double min = 0.0;
  double max = 0.0;
};

/// Where rays are along an axis once they have gone so far along the main one.
inline ConeSpan places_at(double origin_min, double origin_max, double slope_min, double slope_max,
                          ConeSpan depth) {
  return {origin_min + slope_min * (slope_min < 0.0 ? depth.max : depth.min) - kConeRounding,
          origin_max + slope_max * (slope_max > 0.0 ? depth.max : depth.min) + kConeRounding};
}

/// How far along the main axis rays cross a plane of another axis, within `depth`.
inline ConeSpan depths_at_plane(double plane, double origin_min, double origin_max,
                                double slope_min, double slope_max, ConeSpan depth) {
  const bool up = slope_max > 0.0 && plane >= origin_min - kConeRounding;
  const bool down = slope_min < 0.0 && plane <= origin_max + kConeRounding;
  if (up == down) return depth;  // through the box of origins: anywhere
  const double nearest = up ? plane - origin_max : origin_min - plane;
  const double farthest = up ? plane - origin_min : origin_max - plane;
  const double steepest = up ? slope_max : -slope_min;
  const double flattest = up ? slope_min : -slope_max;
  ConeSpan crossed = depth;
  crossed.min = std::max(depth.min, (nearest - kConeRounding) / steepest);
  if (flattest > 0.0) crossed.max = std::min(depth.max, (farthest + kConeRounding) / flattest);
  return crossed.min <= crossed.max ? crossed : depth;
}

/// How far along the main axis rays may have gone when they leave a voxel by its sides across
/// another axis; infinite where some never do.
inline double farthest_exit(int voxel, double origin_min, double origin_max, double slope_min,
                            double slope_max) {
  if (slope_min > 0.0) return (voxel + 1 - origin_min + kConeRounding) / slope_min;
  if (slope_max < 0.0) return (origin_max - voxel + kConeRounding) / -slope_max;
  return std::numeric_limits<double>::infinity();
}

}  // namespace nbvopt::detail
