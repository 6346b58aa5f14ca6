// How much room there is about a point.
#pragma once

#include <Eigen/Core>

#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// The air that is seen from a point in the upper half space, cubic metres; +inf under the open
/// sky, which is whatever is beyond the range.
double air_above_m3(const Scene& scene, const Eigen::Vector3d& origin_map_m, double range_max_m);

/// A mesh does not say what is solid. But a wardrobe, a crate or a bed holds less air than this,
/// and a room that is worth exploring more.
inline constexpr double kLeastAir_m3 = 4.0;

}  // namespace nbvopt
