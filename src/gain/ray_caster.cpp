#include "nbvopt/gain/ray_caster.hpp"

#include <hwy/targets.h>

#include <cmath>

#include "core/enum_names.hpp"
#include "gain/camera_pose_check.hpp"
#include "gain/ray_walk.hpp"
#include "map/brick_table.hpp"
#include "map/map_access.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<SimdLevel> = std::to_array<EnumName<SimdLevel>>({
    {SimdLevel::best, "best"},
    {SimdLevel::avx512, "avx512"},
    {SimdLevel::avx2, "avx2"},
    {SimdLevel::sse4, "sse4"},
    {SimdLevel::scalar, "scalar"},
});

namespace {

/// The keys of a box around the origin, one voxel wider for rounding.
std::pair<Eigen::Vector3i, Eigen::Vector3i> keys_of(const Eigen::Vector3d& origin_lattice,
                                                    const Eigen::Vector3d& min_m,
                                                    const Eigen::Vector3d& max_m,
                                                    double resolution_m) {
  const Eigen::Array3d low = (origin_lattice + min_m / resolution_m).array().floor() - 1.0;
  const Eigen::Array3d high = (origin_lattice + max_m / resolution_m).array().floor() + 1.0;
  return {low.cast<int>(), high.cast<int>()};
}

VoxelKey clamped_key(const Eigen::Vector3i& key) {
  const Eigen::Vector3i k = key.cwiseMax(0).cwiseMin(65535);
  return {static_cast<std::uint16_t>(k.x()), static_cast<std::uint16_t>(k.y()),
          static_cast<std::uint16_t>(k.z())};
}

}  // namespace

RayBundle make_bundle(const CameraRays& rays, const Transform& T_map_sensor, bool near_blocking) {
  return {T_map_sensor, rays.x, rays.y, rays.z, rays.range_min_m, rays.range_max_m, near_blocking};
}

void RayHits::resize(std::size_t n) {
  kind.resize(n);
  face.resize(n);
  voxel.resize(n);
  distance_m.resize(n);
  uncertainty.resize(n);
  direction_x.resize(n);
  direction_y.resize(n);
  direction_z.resize(n);
}

const char* to_string(SimdLevel level) { return enum_name(level).data(); }

std::vector<SimdLevel> supported_simd_levels() {
  std::vector<SimdLevel> levels;
  for (const SimdLevel level : {SimdLevel::avx512, SimdLevel::avx2, SimdLevel::sse4}) {
    if ((detail::simd_kernel_targets() & hwy::SupportedTargets() & detail::hwy_targets(level)) !=
        0) {
      levels.push_back(level);
    }
  }
  levels.push_back(SimdLevel::scalar);
  return levels;
}

namespace detail {
namespace {

/// Gathers the bricks of the box; those that are not ready are made so where a ray may come into
/// them, and elsewhere nothing counts as known.
template <class IsInReach>
void fill_local_bricks(const BrickTable& table, const BrickBox& box, const IsInReach& is_in_reach,
                       LocalBricks& local) {
  check_size(box);
  local.min = box.min;
  local.size_x = box.max.x - box.min.x + 1;
  local.size_y = box.max.y - box.min.y + 1;
  local.size_z = box.max.z - box.min.z + 1;
  local.brick.reserve(static_cast<std::size_t>(box.size()));
  std::vector<BrickKey> missing;
  box.for_each([&](BrickKey key) {
    const Brick* brick = table.ready_brick(key);
    if (brick == nullptr) {
      if (is_in_reach(key)) missing.push_back(key);
      brick = unknown_brick().get();
    }
    local.brick.push_back(brick);
  });
  table.make_ready(missing);
  for (const BrickKey& key : missing) local.brick[local.place_of(key)] = table.ready_brick(key);
  local.code.reserve(local.brick.size());
  for (const Brick* brick : local.brick) local.code.push_back(brick->code.data());
}

}  // namespace

RayWalk make_walk(const VoxelGrid& grid, const RayBundle& rays, double occupied_uncertainty,
                  const RayBounds& bounds) {
  RayWalk walk;
  walk.rays = &rays;
  walk.resolution_m = grid.lattice().resolution_m();
  const Eigen::Vector3d origin_lattice = grid.lattice().to_lattice(rays.T_map_rays.translation());
  const Eigen::Vector3d origin_floor = origin_lattice.array().floor();
  walk.origin_key = origin_floor.cast<int>();
  walk.origin_in_voxel = origin_lattice - origin_floor;
  walk.shortest_range_min_m = bounds.shortest_range_min_m;
  walk.shortest_range_max_m = bounds.shortest_range_max_m;
  walk.look_up_uncertainty = grid.carries_uncertainty();
  walk.occupied_uncertainty =
      grid.carries_uncertainty() ? double{kUnknownUncertainty} : occupied_uncertainty;

  const auto [far_low, far_high] =
      keys_of(origin_lattice, bounds.far_min, bounds.far_max, walk.resolution_m);
  const auto [near_low, near_high] =
      keys_of(origin_lattice, bounds.near_min, bounds.near_max, walk.resolution_m);
  const BrickBox near{brick_at(near_low), brick_at(near_high)};
  // Voxels; one more for rounding.
  const double longest = 1.0 + bounds.longest_range_max_m / walk.resolution_m;
  const auto is_in_reach = [&](BrickKey key) {
    return lattice_box(key).exteriorDistance(origin_lattice) <= longest || near.contains(key);
  };
  fill_local_bricks(MapAccess::table(grid), {brick_at(far_low), brick_at(far_high)}, is_in_reach,
                    walk.bricks);
  if (rays.near_blocking) {
    walk.walk_near = grid.any_occupied({clamped_key(near_low), clamped_key(near_high)});
  }
  return walk;
}

std::int64_t hwy_targets(SimdLevel level) {
  switch (level) {
    case SimdLevel::avx512:
      return HWY_AVX3;
    case SimdLevel::avx2:
      return HWY_AVX2;
    case SimdLevel::sse4:
      return HWY_SSE4;
    case SimdLevel::best:
    case SimdLevel::scalar:
      break;
  }
  return 0;
}

std::int64_t supported_targets(std::int64_t targets) {
  // Asking the processor takes microseconds on a virtual machine.
  static const std::int64_t supported = hwy::SupportedTargets();
  return targets == 0 ? supported : targets & supported;
}

}  // namespace detail

void cast_rays(const VoxelGrid& grid, const RayBundle& rays, double occupied_uncertainty,
               RayHits& hits, SimdLevel level) {
  detail::check_camera_pose(rays.T_map_rays, grid.lattice());
  hits.resize(rays.size());
  const detail::CasterKernel kernel = level == SimdLevel::scalar
                                          ? detail::scalar_kernel()
                                          : detail::simd_kernel(detail::hwy_targets(level));
  const detail::RayBounds bounds = kernel.rotate_and_bound(rays, hits);
  kernel.walk(detail::make_walk(grid, rays, occupied_uncertainty, bounds), hits);
}

}  // namespace nbvopt
