// Batches of rays on their way, two side by side, each taken forward by the cone around it where
// all is free. Included once a Highway target, by the files that walk rays.
#if defined(NBVOPT_GAIN_RAY_BATCHES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NBVOPT_GAIN_RAY_BATCHES_INL_H
#undef NBVOPT_GAIN_RAY_BATCHES_INL_H
#else
#define NBVOPT_GAIN_RAY_BATCHES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "gain/ray_lanes-inl.hpp"
#include "gain/ray_walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

/// How far cones go.
struct ConeReach {
  bool from_origin;  ///< or from range_min
  float margin;      ///< by how many voxels less than it could a cone leaps
};

/// Cones, one a batch of rays: an axis, and by how much the rays' directions differ from it along
/// any coordinate. A cone that lies in cubes of free voxels takes its whole batch forward.
struct ConeGroup {
  alignas(64) std::array<double, kMaxLanes> x{}, y{}, z{};
  alignas(64) std::array<float, kMaxLanes> spread{}, begin{}, end{};

  /// The cone around the rays from `first` on.
  HWY_INLINE void set(std::size_t cone, const RayWalk& walk, const RayHits& hits, std::size_t first,
                      bool from_origin) {
    float widest = 0.0F;
    const auto along = [&](const double* directions) HWY_ATTR {
      const VecF d = load_demoted(directions);
      const float low = hn::GetLane(hn::MinOfLanes(df, d));
      const float high = hn::GetLane(hn::MaxOfLanes(df, d));
      widest = std::max(widest, high - low);
      return 0.5 * (double{low} + double{high});
    };
    x[cone] = along(&hits.direction_x[first]);
    y[cone] = along(&hits.direction_y[first]);
    z[cone] = along(&hits.direction_z[first]);
    spread[cone] = 0.5F * widest;
    const auto scale = static_cast<float>(1.0 / walk.resolution_m);
    begin[cone] =
        from_origin
            ? 0.0F
            : scale * hn::GetLane(hn::MinOfLanes(df, load_demoted(&walk.rays->range_min_m[first])));
    end[cone] =
        scale * hn::GetLane(hn::MinOfLanes(df, load_demoted(&walk.rays->range_max_m[first])));
  }
};

/// Walks cones.
class ConeLanes : public Lanes {
 public:
  /// `margin`: by how many voxels less than it could a cone leaps.
  HWY_INLINE ConeLanes(const RayWalk& walk, const ConeGroup& cones, float margin)
      : Lanes(walk, cones.x.data(), cones.y.data(), cones.z.data()),
        margin_(margin),
        spread_(hn::Load(df, cones.spread.data())),
        distance_(hn::Load(df, cones.begin.data())),
        end_(hn::Load(df, cones.end.data())) {}

  /// The distance, in voxels, up to which every ray of a cone passes free voxels only.
  HWY_INLINE VecF march() {
    constexpr float kRounding = 0.01F;   // voxels
    constexpr float kWorthwhile = 1.0F;  // voxels
    const VecF steepest = hn::Max(x_.direction, hn::Max(y_.direction, z_.direction));
    const VecF per_voxel = hn::Div(hn::Set(df, 1.0F), hn::Add(steepest, spread_));
    MaskF active = hn::FirstN(df, hn::Lanes(df));
    while (!hn::AllFalse(df, active)) {
      place_at(distance_);
      const VecI code = gather_codes();
      const MaskF is_free = hn::RebindMask(df, hn::Lt(code, hn::Set(di, kUnknownCode)));
      // The cube reaches `radius` from the axis at least; a ray strays from it by
      // leap * steepest + (distance + leap) * spread.
      const VecF radius = hn::Sub(leap_radius_of(code), hn::Set(df, margin_ + kRounding));
      const VecF leap = hn::Mul(hn::NegMulAdd(distance_, spread_, radius), per_voxel);
      active = hn::And(hn::And(active, is_free), hn::Ge(leap, hn::Set(df, kWorthwhile)));
      distance_ = hn::IfThenElse(active, hn::Min(hn::Add(distance_, leap), end_), distance_);
      active = hn::And(active, hn::Lt(distance_, end_));
    }
    return distance_;
  }

 private:
  float margin_;
  VecF spread_, distance_, end_;
};

/// Walks all rays, at least as many as a vector has lanes. `make_batch(first, free_up_to)` makes
/// the batch from ray `first` on, whose rays pass free voxels only up to that distance in voxels;
/// `step()` takes it on while it `is_active()`; `store(batch)` keeps what it found.
template <class MakeBatch, class Store>
HWY_INLINE void walk_batches(const RayWalk& walk, const RayHits& hits, ConeReach reach,
                             const MakeBatch& make_batch, const Store& store) {
  const std::size_t lanes = hn::Lanes(df);
  const std::size_t n = walk.rays->size();
  const std::size_t batches = (n + lanes - 1) / lanes;
  const auto first_ray = [&](std::size_t batch) {
    return std::min(batch * lanes, n - lanes);  // the last batch may overlap
  };
  ConeGroup cones;
  for (std::size_t group = 0; group < batches; group += lanes) {
    const std::size_t group_size = std::min(lanes, batches - group);
    for (std::size_t c = 0; c < lanes; ++c) {
      cones.set(c, walk, hits, first_ray(group + std::min(c, group_size - 1)), reach.from_origin);
    }
    alignas(64) std::array<float, kMaxLanes> free_up_to;
    hn::Store(ConeLanes(walk, cones, reach.margin).march(), df, free_up_to.data());
    for (std::size_t c = 0; c < group_size; c += 2) {
      // Two batches side by side: one computes while the other waits for memory.
      const std::size_t d = std::min(c + 1, group_size - 1);
      auto first = make_batch(first_ray(group + c), free_up_to[c]);
      auto second = make_batch(first_ray(group + d), free_up_to[d]);
      while (first.is_active() || second.is_active()) {
        first.step();
        second.step();
      }
      store(first);
      store(second);
    }
  }
}

#endif  // HWY_TARGET != HWY_SCALAR
}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
