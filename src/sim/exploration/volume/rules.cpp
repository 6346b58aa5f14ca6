#include "sim/exploration/volume/rules.hpp"

#include <numbers>

namespace nbvopt {
namespace {

constexpr double kHalfDegree_rad = std::numbers::pi / 360.0;

SensorOptions camera(double fov_horizontal_deg, double fov_vertical_deg, double range_max_m) {
  SensorOptions camera;
  camera.half_fov_horizontal_rad = fov_horizontal_deg * kHalfDegree_rad;
  camera.half_fov_vertical_rad = fov_vertical_deg * kHalfDegree_rad;
  camera.ray_pattern = RayPattern::equal_angles;
  camera.range_max_m = range_max_m;
  // Frames as dense as voxels of 0.05 m are at any range.
  camera.horizontal_pixels = 240;
  camera.vertical_pixels = 180;
  return camera;
}

VolumeRules bai2016() {
  VolumeRules rules{.camera = camera(57.0, 43.0, 6.0),
                    .slice_height_m = 0.425,
                    .looks_both_ways = true,
                    .group_radius_m = 0.4,
                    .headings = 30,
                    .ring_min_m = 1.0,
                    .ring_max_m = 5.0,
                    .frontier_gap_m = 0.3,
                    .sensor_gap_m = 0.25,
                    .divides_by_way = true,
                    .length_scale_m = 3.0,
                    .wraps_yaw = true,
                    .candidates_at_end = 3};
  rules.camera.horizontal_rays = 128;
  rules.camera.vertical_rays = 96;
  return rules;
}

VolumeRules tekniker() {
  VolumeRules rules{.camera = camera(59.0, 46.0, 4.0),
                    .slice_height_m = 0.525,
                    .looks_both_ways = false,
                    .group_radius_m = 0.5,
                    .headings = 12,
                    .ring_min_m = 0.5,
                    .ring_max_m = 6.0,
                    .frontier_gap_m = 0.5,
                    .sensor_gap_m = 0.5,
                    .divides_by_way = false,
                    // It scales inputs by sqrt(3) / length^2 instead of sqrt(3) / length.
                    .length_scale_m = 9.0,
                    // It scales yaws before it looks whether they are more than half a turn apart.
                    .wraps_yaw = false,
                    .candidates_at_end = 2};
  rules.camera.horizontal_rays = 480;
  rules.camera.vertical_rays = 360;
  return rules;
}

}  // namespace

VolumeRules rules_of(VolumeExplorer explorer) {
  return explorer == VolumeExplorer::bai2016 ? bai2016() : tekniker();
}

}  // namespace nbvopt
