#include "gain/view_rays.hpp"

#include "gain/camera_pose_check.hpp"
#include "gain/scalar_ray.hpp"

namespace nbvopt::detail {
namespace {

VoxelState state_of(std::uint8_t code) {
  if (is_free_code(code)) return VoxelState::free;
  return is_unknown_code(code) ? VoxelState::unknown : VoxelState::occupied;
}

}  // namespace

void ViewRays::walk(const VoxelGrid& grid, const DepthCamera& camera,
                    const Transform& T_map_sensor) {
  check_camera_pose(T_map_sensor, grid.lattice());
  const SensorOptions& sensor = camera.options();
  const RayBundle rays = make_bundle(camera.rays(), T_map_sensor, sensor.near_blocking);
  RayHits directions;
  directions.resize(rays.size());
  const RayBounds bounds = scalar_kernel().rotate_and_bound(rays, directions);
  const RayWalk walk = make_walk(grid, rays, sensor.occupied_uncertainty, bounds);
  voxels_.clear();
  begin_.assign(1, 0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double near = rays.range_min_m[i] / walk.resolution_m;
    const double far = rays.range_max_m[i] / walk.resolution_m;
    ScalarRay ray(
        walk, {directions.direction_x[i], directions.direction_y[i], directions.direction_z[i]});
    bool goes_on = !walk.walk_near || !ray.is_blocked_before(near);
    if (goes_on) ray.start_at(near);
    while (goes_on) {
      const std::uint8_t code = ray.code();
      const VoxelState state = state_of(code);
      voxels_.push_back(
          {ray.key(), state, is_unknown_code(code) && (code & kBesideSurfaceBit) != 0});
      const double exit = ray.exit_of_cube(0);
      goes_on = state != VoxelState::occupied && exit < far;
      if (goes_on) ray.leap(0, exit);
    }
    begin_.push_back(voxels_.size());
  }
}

}  // namespace nbvopt::detail
