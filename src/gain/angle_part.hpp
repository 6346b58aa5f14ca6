// The part of Eq. 8 that a ray brings along, whatever it hits.
#pragma once

#include <vector>

#include "nbvopt/sensor/depth_camera.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt::detail {

/// The weighted u_alpha of every ray: u is this + distance_weight() * u_d.
inline std::vector<double> angle_part(const UncertaintyModel& uncertainty, const CameraRays& rays) {
  std::vector<double> part;
  part.reserve(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    part.push_back(uncertainty.angle_weight() * uncertainty.angle_uncertainty(rays.direction(i)));
  }
  return part;
}

}  // namespace nbvopt::detail
