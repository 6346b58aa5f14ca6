#include "nbvopt/sensor/depth_camera.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {
namespace {

/// The tangent of pixel i of n across a half field of view.
double tangent(RayPattern pattern, double half_fov_rad, int i, int n) {
  if (pattern == RayPattern::pixel_centres) {
    return std::tan(half_fov_rad) * (2.0 * (i + 0.5) / n - 1.0);
  }
  // From edge to edge: n - 1 intervals; a single ray looks ahead.
  return n == 1 ? 0.0 : std::tan(half_fov_rad * (2.0 * i / (n - 1) - 1.0));
}

/// The places of an image's rays, tile by tile. A tile is as many rays as the widest vector holds.
std::vector<std::size_t> tiled_order(int width, int height) {
  constexpr int kTile = 4;
  std::vector<std::size_t> order;
  for (int top = 0; top < height; top += kTile) {
    for (int left = 0; left < width; left += kTile) {
      for (int row = top; row < std::min(top + kTile, height); ++row) {
        for (int column = left; column < std::min(left + kTile, width); ++column) {
          order.push_back(static_cast<std::size_t>(row) * width + column);
        }
      }
    }
  }
  return order;
}

}  // namespace

DepthCamera::DepthCamera(const SensorOptions& options) : options_(options) {
  options_.validate();
  const CameraRays by_row = make_rays(options_, options_.horizontal_rays, options_.vertical_rays);
  for (const std::size_t i : tiled_order(options_.horizontal_rays, options_.vertical_rays)) {
    rays_.x.push_back(by_row.x[i]);
    rays_.y.push_back(by_row.y[i]);
    rays_.z.push_back(by_row.z[i]);
    rays_.range_min_m.push_back(by_row.range_min_m[i]);
    rays_.range_max_m.push_back(by_row.range_max_m[i]);
  }
}

CameraRays make_rays(const SensorOptions& options, int width, int height) {
  CameraRays rays;
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (auto* field : {&rays.x, &rays.y, &rays.z, &rays.range_min_m, &rays.range_max_m}) {
    field->reserve(n);
  }
  for (int row = 0; row < height; ++row) {
    const double y = tangent(options.ray_pattern, options.half_fov_vertical_rad, row, height);
    for (int column = 0; column < width; ++column) {
      const double x = tangent(options.ray_pattern, options.half_fov_horizontal_rad, column, width);
      const double length = std::sqrt(x * x + y * y + 1.0);
      rays.x.push_back(x / length);
      rays.y.push_back(y / length);
      rays.z.push_back(1.0 / length);
      const double stretch = options.range_axis == RangeAxis::z_depth ? length : 1.0;
      rays.range_min_m.push_back(options.range_min_m * stretch);
      rays.range_max_m.push_back(options.range_max_m * stretch);
    }
  }
  return rays;
}

}  // namespace nbvopt
