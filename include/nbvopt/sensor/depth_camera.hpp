// The camera's rays.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// The rays of one image in the sensor frame. Structure of arrays, all of size
/// horizontal * vertical.
struct CameraRays {
  std::vector<double> x, y, z;                   ///< unit direction
  std::vector<double> range_min_m, range_max_m;  ///< along the ray, from the optical centre

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d direction(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// A pinhole depth camera.
class DepthCamera {
 public:
  /// Throws InputError as SensorOptions::validate() does.
  explicit DepthCamera(const SensorOptions& options);

  const SensorOptions& options() const { return options_; }

  /// The planning rays, horizontal_rays * vertical_rays, in tiles of 4 x 4: neighbours in the
  /// image are neighbours in order, so that vectors of rays run together.
  const CameraRays& rays() const { return rays_; }

 private:
  SensorOptions options_;
  CameraRays rays_;
};

/// The rays of an image of width x height with this camera's field of view, pattern and range, row
/// by row from the top left.
CameraRays make_rays(const SensorOptions& options, int width, int height);

}  // namespace nbvopt
