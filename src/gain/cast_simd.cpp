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
  HWY_INLINE explicit Batch(const RayWalk& walk) : HitLanes(walk) {}

  /// Starts where something near may block rays, else at range_min, or farther where all before is
  /// known to be free.
  HWY_INLINE void start(const RayHits& hits, std::size_t first, FreeWay free) {
    set_up(hits, first);
    code_ = hn::Zero(di);
    free_from_near_ = free.from_near;
    if (walk_->walk_near) {
      const VecF begin = hn::Set(df, free.from_origin);
      active_ = hn::Lt(begin, near_);
      is_near_ = any_goes_on();
      if (is_near_) {
        place_at(begin);
        return;
      }
    }
    start_far();
  }

  HWY_INLINE bool is_active() const { return is_near_ || any_goes_on(); }

  /// Takes every active ray behind the cube that its code speaks for.
  HWY_INLINE void step() {
    const VecI code = gather_codes();
    const MaskF is_free = hn::RebindMask(df, hn::Lt(code, hn::Set(di, kUnknownCode)));
    if (is_near_) {
      step_near(code, is_free);
      return;
    }
    code_ = hn::IfThenElse(hn::RebindMask(di, active_), code, code_);
    const CubeExit exit = exit_of_cube(leap_radius_of(code));
    active_ = hn::And(hn::And(active_, is_free), hn::Lt(exit.distance, far_));
    leap(active_, exit, entered_axis_);
  }

  HWY_INLINE void store_all(RayHits& hits) {
    hit_ = hn::RebindMask(df, hn::Gt(code_, hn::Set(di, kUnknownCode - 1)));
    occupied_ = hn::RebindMask(df, hn::Eq(code_, hn::Set(di, kOccupiedCode)));
    store(hits);
  }

 private:
  HWY_INLINE bool any_goes_on() const { return !hn::AllFalse(df, active_); }

  /// On the way to range_min: marks the rays that an occupied voxel, left before, blocks.
  HWY_INLINE void step_near(VecI code, MaskF is_free) {
    const MaskF occupied = hn::RebindMask(df, hn::Eq(code, hn::Set(di, kOccupiedCode)));
    // Unknown voxels there are passed one by one.
    const CubeExit exit = exit_of_cube(hn::IfThenElseZero(is_free, leap_radius_of(code)));
    const MaskF before_near = hn::And(active_, hn::Lt(exit.distance, near_));
    blocked_ = hn::Or(blocked_, hn::And(before_near, occupied));
    active_ = hn::AndNot(occupied, before_near);
    leap(active_, exit, entered_axis_);
    if (!any_goes_on()) start_far();
  }

  HWY_INLINE void start_far() {
    is_near_ = false;
    active_ = hn::Not(blocked_);
    start_at(hn::Max(near_, hn::Set(df, free_from_near_)));
  }

  float free_from_near_ = 0.0F;
  bool is_near_ = false;  ///< on the way to range_min
  VecI code_;             ///< of the last voxel
};

void walk_rays(const RayWalk& walk, RayHits& hits) {
  if (walk.rays->size() < hn::Lanes(df)) {
    scalar_kernel().walk(walk, hits);
    return;
  }
  const auto store = [&](Batch& batch) HWY_ATTR { batch.store_all(hits); };
  walk_batches(walk, hits, {.from_origin = walk.walk_near, .margin = 0.0F}, Batch(walk), store);
}

RayBounds rotate_and_bound(const RayBundle& rays, RayHits& hits) {
  const std::size_t lanes = hn::Lanes(dd);
  const std::size_t n = rays.size();
  if (n < lanes) return scalar_kernel().rotate_and_bound(rays, hits);

  const Eigen::Matrix3d R = rays.T_map_rays.linear();
  const std::array<double*, 3> direction{hits.direction_x.data(), hits.direction_y.data(),
                                         hits.direction_z.data()};
  struct Along {
    VecD r0, r1, r2;
    VecD far_min, far_max, near_min, near_max;
  };
  std::array<Along, 3> along;
  for (int a = 0; a < 3; ++a) {
    const VecD zero = hn::Zero(dd);
    along[a] = {
        hn::Set(dd, R(a, 0)), hn::Set(dd, R(a, 1)), hn::Set(dd, R(a, 2)), zero, zero, zero, zero};
  }
  VecD shortest_near = hn::LoadU(dd, rays.range_min_m.data());
  VecD shortest_far = hn::LoadU(dd, rays.range_max_m.data());
  VecD longest_far = shortest_far;
  for (std::size_t next = 0; next < n; next += lanes) {
    const std::size_t i = std::min(next, n - lanes);
    const VecD x = hn::LoadU(dd, &rays.x[i]);
    const VecD y = hn::LoadU(dd, &rays.y[i]);
    const VecD z = hn::LoadU(dd, &rays.z[i]);
    const VecD range_min = hn::LoadU(dd, &rays.range_min_m[i]);
    const VecD range_max = hn::LoadU(dd, &rays.range_max_m[i]);
    shortest_near = hn::Min(shortest_near, range_min);
    shortest_far = hn::Min(shortest_far, range_max);
    longest_far = hn::Max(longest_far, range_max);
    for (int a = 0; a < 3; ++a) {
      Along& by = along[a];
      const VecD d = hn::MulAdd(by.r0, x, hn::MulAdd(by.r1, y, hn::Mul(by.r2, z)));
      hn::StoreU(d, dd, direction[a] + i);
      const VecD far = hn::Mul(d, range_max);
      const VecD near = hn::Mul(d, range_min);
      by.far_min = hn::Min(by.far_min, far);
      by.far_max = hn::Max(by.far_max, far);
      by.near_min = hn::Min(by.near_min, near);
      by.near_max = hn::Max(by.near_max, near);
    }
  }
  RayBounds bounds;
  for (int a = 0; a < 3; ++a) {
    bounds.far_min[a] = hn::GetLane(hn::MinOfLanes(dd, along[a].far_min));
    bounds.far_max[a] = hn::GetLane(hn::MaxOfLanes(dd, along[a].far_max));
    bounds.near_min[a] = hn::GetLane(hn::MinOfLanes(dd, along[a].near_min));
    bounds.near_max[a] = hn::GetLane(hn::MaxOfLanes(dd, along[a].near_max));
  }
  bounds.shortest_range_min_m = hn::GetLane(hn::MinOfLanes(dd, shortest_near));
  bounds.shortest_range_max_m = hn::GetLane(hn::MinOfLanes(dd, shortest_far));
  bounds.longest_range_max_m = hn::GetLane(hn::MaxOfLanes(dd, longest_far));
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
