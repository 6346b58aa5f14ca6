// Eq. 12 over many rays at once.
#pragma once

#include "nbvopt/gain/gain_model.hpp"

namespace nbvopt::detail {

/// u_new of ray i is angle_part[i] + distance_weight * u_d(distance), Eq. 2 and 8.
struct RayGainModel {
  std::vector<double> angle_part;
  double distance_weight = 0.5;
  double focal_distance_m = 1.0;
};

/// Writes the gain of every ray (Eq. 12) and returns the view's, counted per ray (Eq. 13).
ViewGain ray_gains(const RayGainModel& model, const RayHits& hits, std::vector<double>& ray_gain);

}  // namespace nbvopt::detail
