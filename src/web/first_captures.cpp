#include "web/first_captures.hpp"

#include <algorithm>
#include <cmath>

#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {
namespace {

/// How many rays side by side see every voxel at the range's end, at most as many as pixels.
int ray_count(double half_angle_rad, double range_m, double resolution_m, int pixels) {
  const double rays = 2.0 * std::tan(half_angle_rad) * range_m / (0.5 * resolution_m);
  return static_cast<int>(std::clamp(std::ceil(rays), 2.0, static_cast<double>(pixels)));
}

}  // namespace

std::unordered_map<std::uint64_t, std::uint16_t> first_captures(
    const VoxelGrid& grid, const SensorOptions& sensor,
    std::span<const Transform> poses_T_map_sensor) {
  const double resolution_m = grid.lattice().resolution_m();
  const CameraRays rays = make_rays(sensor,
                                    ray_count(sensor.half_fov_horizontal_rad, sensor.range_max_m,
                                              resolution_m, sensor.horizontal_pixels),
                                    ray_count(sensor.half_fov_vertical_rad, sensor.range_max_m,
                                              resolution_m, sensor.vertical_pixels));
  std::unordered_map<std::uint64_t, std::uint16_t> first;
  RayHits hits;
  for (std::size_t pose = 0; pose < poses_T_map_sensor.size(); ++pose) {
    cast_rays(grid, make_bundle(rays, poses_T_map_sensor[pose], sensor.near_blocking),
              sensor.occupied_uncertainty, hits);
    for (std::size_t ray = 0; ray < hits.size(); ++ray) {
      if (hits.kind[ray] != HitKind::occupied) continue;
      first.try_emplace(packed(hits.voxel[ray]), static_cast<std::uint16_t>(pose));
    }
  }
  return first;
}

}  // namespace nbvopt
