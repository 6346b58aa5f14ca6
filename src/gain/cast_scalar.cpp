// The caster one ray at a time, in double precision: the plain statement of what the vectorised
// one does, and its fallback.
#include <algorithm>
#include <limits>

#include "gain/scalar_ray.hpp"

namespace nbvopt::detail {
namespace {

void walk_ray(const RayWalk& walk, std::size_t i, RayHits& hits) {
  const double near = walk.rays->range_min_m[i] / walk.resolution_m;
  const double far = walk.rays->range_max_m[i] / walk.resolution_m;
  ScalarRay ray(walk, {hits.direction_x[i], hits.direction_y[i], hits.direction_z[i]});
  hits.kind[i] = HitKind::none;
  hits.face[i] = Face::inside;
  hits.voxel[i] = {};
  hits.distance_m[i] = walk.rays->range_max_m[i];
  hits.uncertainty[i] = kUnknownUncertainty;
  if (walk.walk_near && ray.is_blocked_before(near)) {
    hits.kind[i] = HitKind::blocked;
    return;
  }
  ray.start_at(near);
  std::uint8_t code = ray.code();
  while (is_free_code(code)) {
    const int radius = leap_radius(code);
    const double t = ray.exit_of_cube(radius);
    if (t >= far) return;
    ray.leap(radius, t);
    code = ray.code();
  }
  hits.face[i] = ray.face();
  hits.voxel[i] = ray.key();
  hits.distance_m[i] = ray.entry_distance_m(walk.rays->range_min_m[i]);
  if (is_unknown_code(code)) {
    hits.kind[i] = HitKind::unknown;
    return;
  }
  hits.kind[i] = HitKind::occupied;
  const Brick* brick = walk.bricks.brick[walk.bricks.place_of(brick_of(hits.voxel[i]))];
  hits.uncertainty[i] = brick->states->uncertainty_of_occupied(
      hits.voxel[i], static_cast<float>(walk.occupied_uncertainty));
}

RayBounds rotate_and_bound(const RayBundle& rays, RayHits& hits) {
  const Eigen::Matrix3d R = rays.T_map_rays.linear();
  RayBounds bounds;
  bounds.shortest_range_min_m = bounds.shortest_range_max_m =
      std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d d = R * Eigen::Vector3d(rays.x[i], rays.y[i], rays.z[i]);
    hits.direction_x[i] = d.x();
    hits.direction_y[i] = d.y();
    hits.direction_z[i] = d.z();
    bounds.shortest_range_min_m = std::min(bounds.shortest_range_min_m, rays.range_min_m[i]);
    bounds.shortest_range_max_m = std::min(bounds.shortest_range_max_m, rays.range_max_m[i]);
    bounds.longest_range_max_m = std::max(bounds.longest_range_max_m, rays.range_max_m[i]);
    bounds.far_min = bounds.far_min.cwiseMin(d * rays.range_max_m[i]);
    bounds.far_max = bounds.far_max.cwiseMax(d * rays.range_max_m[i]);
    bounds.near_min = bounds.near_min.cwiseMin(d * rays.range_min_m[i]);
    bounds.near_max = bounds.near_max.cwiseMax(d * rays.range_min_m[i]);
  }
  return bounds;
}

void walk_all(const RayWalk& walk, RayHits& hits) {
  for (std::size_t i = 0; i < walk.rays->size(); ++i) walk_ray(walk, i, hits);
}

}  // namespace

CasterKernel scalar_kernel() { return {rotate_and_bound, walk_all}; }

}  // namespace nbvopt::detail
