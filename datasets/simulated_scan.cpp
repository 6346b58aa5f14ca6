#include "simulated_scan.hpp"

#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {

Scan simulate_scan(const VoxelGrid& world, const SensorOptions& sensor,
                   const Transform& T_map_sensor) {
  // A hit lies on the face by which its ray enters the voxel; a surface is a little behind it.
  constexpr double kBehindFace_m = 1e-4;

  const CameraRays rays = make_rays(sensor, sensor.horizontal_pixels, sensor.vertical_pixels);
  RayHits hits;
  cast_rays(world, make_bundle(rays, T_map_sensor, true), sensor.occupied_uncertainty, hits,
            SimdLevel::scalar);

  Scan scan;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d direction_sensor = rays.direction(i);
    switch (hits.kind[i]) {
      case HitKind::occupied:
        scan.points_m.push_back(
            ((hits.distance_m[i] + kBehindFace_m) * direction_sensor).cast<float>());
        break;
      case HitKind::none:
      case HitKind::unknown:
        scan.no_returns.push_back(direction_sensor.cast<float>());
        break;
      case HitKind::blocked:
        break;
    }
  }
  return scan;
}

}  // namespace nbvopt
