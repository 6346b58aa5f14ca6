// The vectorised caster: one ray a lane, in single precision within a few hundred voxels of the
// origin; what a hit reports is computed again in double precision from its voxel and face, so
// that all instruction sets agree to rounding where they agree on the voxel.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gain/cast_simd.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "gain/ray_batches-inl.hpp"
#include "gain/ray_lanes-inl.hpp"
#include "gain/ray_walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR
CasterKernel kernel() { return scalar_kernel(); }
#else

/// A batch of rays on their way to what they hit.
class Batch : public HitLanes {
 public:
  /// Starts at range_min, or farther where all before is known to be free.
  HWY_INLINE Batch(const RayWalk& walk, const RayHits& hits, std::size_t first, float free_up_to)
      : HitLanes(walk, hits, first) {
    if (walk.walk_near) walk_near();
    start_at(hn::Max(near_, hn::Set(df, free_up_to)));
  }

  /// Takes every active ray behind the cube that its code speaks for.
  HWY_INLINE void step() {
    const VecI code = gather_codes();
    const MaskF stopped = hn::RebindMask(df, hn::Gt(code, hn::Set(di, kUnknownCode - 1)));
    const VecF radius = leap_radius_of(code);
    const MaskF hit = hn::And(active_, stopped);
    hit_ = hn::Or(hit_, hit);
    occupied_ = hn::Or(occupied_,
                       hn::And(hit, hn::RebindMask(df, hn::Eq(code, hn::Set(di, kOccupiedCode)))));
    active_ = leap_where(hn::AndNot(stopped, active_), radius, far_, stopped);
  }

 private:
  /// Marks the rays that an occupied voxel, left before range_min, blocks.
  HWY_INLINE void walk_near() {
    start_at(hn::Zero(df));
    while (is_active()) {
      const VecI code = gather_codes();
      const MaskF occupied = hn::RebindMask(df, hn::Eq(code, hn::Set(di, kOccupiedCode)));
      // Unknown voxels there are passed one by one.
      const MaskF is_free = hn::RebindMask(df, hn::Lt(code, hn::Set(di, kUnknownCode)));
      const VecF radius = hn::IfThenElseZero(is_free, leap_radius_of(code));
      const MaskF before_near = leap_where(active_, radius, near_, occupied);
      blocked_ = hn::Or(blocked_, hn::And(before_near, occupied));
      active_ = hn::AndNot(occupied, before_near);
    }
    active_ = hn::Not(blocked_);
  }

  /// Of the `candidates`, those that leave their cube before `end` are returned, and, but for the
  /// `frozen`, leap behind its surface.
  HWY_INLINE MaskF leap_where(MaskF candidates, VecF radius, VecF end, MaskF frozen) {
    const CubeExit exit = exit_of_cube(radius);
    const MaskF before_end = hn::And(candidates, hn::Lt(exit.distance, end));
    leap(hn::AndNot(frozen, before_end), exit, entered_axis_);
    return before_end;
  }
};

void walk_rays(const RayWalk& walk, RayHits& hits) {
  if (walk.rays->size() < hn::Lanes(df)) {
    scalar_kernel().walk(walk, hits);
    return;
  }
  const auto make_batch = [&](std::size_t first, float free_up_to)
                              HWY_ATTR { return Batch(walk, hits, first, free_up_to); };
  const auto store = [&](const Batch& batch) HWY_ATTR { batch.store(hits); };
  walk_batches(walk, hits, {.from_origin = false, .margin = 0.0F}, make_batch, store);
}

RayBounds rotate_and_bound(const RayBundle& rays, RayHits& hits) {
  const std::size_t lanes = hn::Lanes(dd);
  const std::size_t n = rays.size();
  if (n < lanes) return scalar_kernel().rotate_and_bound(rays, hits);

  const Eigen::Matrix3d R = rays.T_map_rays.linear();
  const std::array<double*, 3> direction{hits.direction_x.data(), hits.direction_y.data(),
                                         hits.direction_z.data()};
  RayBounds bounds;
  for (int a = 0; a < 3; ++a) {
    const VecD r0 = hn::Set(dd, R(a, 0));
    const VecD r1 = hn::Set(dd, R(a, 1));
    const VecD r2 = hn::Set(dd, R(a, 2));
    VecD far_min = hn::Zero(dd), far_max = hn::Zero(dd);
    VecD near_min = hn::Zero(dd), near_max = hn::Zero(dd);
    for (std::size_t next = 0; next < n; next += lanes) {
      const std::size_t i = std::min(next, n - lanes);
      const VecD d = hn::MulAdd(
          r0, hn::LoadU(dd, &rays.x[i]),
          hn::MulAdd(r1, hn::LoadU(dd, &rays.y[i]), hn::Mul(r2, hn::LoadU(dd, &rays.z[i]))));
      hn::StoreU(d, dd, direction[a] + i);
      const VecD far = hn::Mul(d, hn::LoadU(dd, &rays.range_max_m[i]));
      const VecD near = hn::Mul(d, hn::LoadU(dd, &rays.range_min_m[i]));
      far_min = hn::Min(far_min, far);
      far_max = hn::Max(far_max, far);
      near_min = hn::Min(near_min, near);
      near_max = hn::Max(near_max, near);
    }
    bounds.far_min[a] = hn::GetLane(hn::MinOfLanes(dd, far_min));
    bounds.far_max[a] = hn::GetLane(hn::MaxOfLanes(dd, far_max));
    bounds.near_min[a] = hn::GetLane(hn::MinOfLanes(dd, near_min));
    bounds.near_max[a] = hn::GetLane(hn::MaxOfLanes(dd, near_max));
  }
  return bounds;
}

CasterKernel kernel() { return {rotate_and_bound, walk_rays}; }
#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(kernel);

std::int64_t simd_kernel_targets() { return HWY_TARGETS; }

CasterKernel simd_kernel(std::int64_t targets) {
  hwy::ChosenTarget chosen;
  chosen.Update(supported_targets(targets));
  return HWY_DISPATCH_TABLE(kernel)[chosen.GetIndex()]();
}

}  // namespace nbvopt::detail
#endif
