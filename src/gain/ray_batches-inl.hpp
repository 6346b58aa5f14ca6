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

/// How cones go.
struct ConeReach {
  bool from_origin;  ///< or from range_min on only
  float margin;      ///< by how many voxels less than it could a cone leaps
};

/// The distances, in voxels, up to which all rays of a batch pass free voxels only: from the origin
/// on, 0 where no cone starts there, and from range_min on.
struct FreeWay {
  float from_origin;
  float from_near;
};

/// Cones, one a batch of rays: an axis, and by how much the rays' directions differ from it at most
/// along any coordinate. A cone that lies in cubes of free voxels takes its whole batch forward.
struct ConeGroup {
  alignas(64) std::array<double, kMaxLanes> x{}, y{}, z{};
  alignas(64) std::array<float, kMaxLanes> spread{};

  /// The cone around the rays from `first` on. The axis lies between the first and the last ray,
  /// which are opposite corners of a tile.
  HWY_INLINE void set(std::size_t cone, const RayHits& hits, std::size_t first) {
    VecF differs = hn::Zero(df);
    const auto between = [&](const double* directions) HWY_ATTR {
      const auto middle = static_cast<float>(0.5 * (directions[0] + directions[hn::Lanes(df) - 1]));
      differs = hn::Max(differs, hn::Abs(hn::Sub(load_demoted(directions), hn::Set(df, middle))));
      return double{middle};
    };
    x[cone] = between(&hits.direction_x[first]);
    y[cone] = between(&hits.direction_y[first]);
    z[cone] = between(&hits.direction_z[first]);
    spread[cone] = hn::GetLane(hn::MaxOfLanes(df, differs));
  }
};

/// As many cones as a vector has lanes, on their way from a distance on.
class ConeLanes : public Lanes {
 public:
  HWY_INLINE ConeLanes(const RayWalk& walk, const ConeGroup& cones, float margin)
      : Lanes(walk), margin_(margin), spread_(hn::Load(df, cones.spread.data())) {
    set_up(walk, cones.x.data(), cones.y.data(), cones.z.data());
    const auto scale = static_cast<float>(1.0 / walk.resolution_m);
    end_ = hn::Set(df, scale * static_cast<float>(walk.shortest_range_max_m));
    const VecF steepest = hn::Max(x_.direction, hn::Max(y_.direction, z_.direction));
    per_voxel_ = hn::Div(hn::Set(df, 1.0F), hn::Add(steepest, spread_));
  }

  HWY_INLINE void start(VecF distance) {
    distance_ = distance;
    active_ = hn::Lt(distance_, end_);
  }

  HWY_INLINE bool is_active() const { return !hn::AllFalse(df, active_); }

  /// Up to where every ray of a cone passes free voxels only, from where it started, in voxels.
  HWY_INLINE VecF distance() const { return distance_; }

  HWY_INLINE void step() {
    constexpr float kRounding = 0.01F;   // voxels
    constexpr float kWorthwhile = 1.0F;  // voxels
    place_at(distance_);
    const VecI code = gather_codes();
    const MaskF is_free = hn::RebindMask(df, hn::Lt(code, hn::Set(di, kUnknownCode)));
    // The cube reaches `radius` from the axis at least; a ray strays from it by
    // leap * steepest + (distance + leap) * spread.
    const VecF radius = hn::Sub(leap_radius_of(code), hn::Set(df, margin_ + kRounding));
    const VecF leap = hn::Mul(hn::NegMulAdd(distance_, spread_, radius), per_voxel_);
    active_ = hn::And(hn::And(active_, is_free), hn::Ge(leap, hn::Set(df, kWorthwhile)));
    distance_ = hn::IfThenElse(active_, hn::Min(hn::Add(distance_, leap), end_), distance_);
    active_ = hn::And(active_, hn::Lt(distance_, end_));
  }

 private:
  float margin_;
  VecF spread_, per_voxel_, end_, distance_;
  MaskF active_;
};

/// The batches of a bundle, each with the free way that its cone found.
class BatchQueue {
 public:
  /// Of at least as many rays as a vector has lanes.
  HWY_INLINE BatchQueue(const RayWalk& walk, const RayHits& hits, ConeReach reach)
      : walk_(walk),
        hits_(hits),
        reach_(reach),
        ray_count_(walk.rays->size()),
        count_((ray_count_ + hn::Lanes(df) - 1) / hn::Lanes(df)) {}

  bool is_empty() const { return next_ == count_; }

  /// Starts `batch` on the next rays.
  template <class Batch>
  HWY_INLINE void start_next(Batch& batch) {
    const std::size_t ahead = 2 * hn::Lanes(df);
    if (next_ % ahead == 0) send_cones();
    batch.start(hits_, first_ray(next_), free_[next_ % ahead]);
    ++next_;
  }

 private:
  std::size_t first_ray(std::size_t batch) const {
    return std::min(batch * hn::Lanes(df), ray_count_ - hn::Lanes(df));  // the last may overlap
  }

  /// Sends the cones of the next batches, two groups side by side.
  HWY_INLINE void send_cones() {
    std::array<ConeGroup, 2> groups;
    std::size_t batch = next_;
    for (ConeGroup& group : groups) {
      for (std::size_t c = 0; c < hn::Lanes(df); ++c) {
        group.set(c, hits_, first_ray(std::min(batch++, count_ - 1)));
      }
    }
    ConeLanes first(walk_, groups[0], reach_.margin);
    ConeLanes second(walk_, groups[1], reach_.margin);
    const auto march = [&]() HWY_ATTR {
      while (first.is_active() || second.is_active()) {
        first.step();
        second.step();
      }
    };
    const VecF zero = hn::Zero(df);
    const VecF near =
        hn::Set(df, static_cast<float>(walk_.shortest_range_min_m / walk_.resolution_m));
    const auto keep = [&](float FreeWay::*way) HWY_ATTR {
      alignas(64) std::array<float, 2 * kMaxLanes> distance;
      hn::Store(first.distance(), df, distance.data());
      hn::Store(second.distance(), df, distance.data() + hn::Lanes(df));
      for (std::size_t i = 0; i < 2 * hn::Lanes(df); ++i) free_[i].*way = distance[i];
    };
    if (reach_.from_origin) {
      first.start(zero);
      second.start(zero);
      march();
      keep(&FreeWay::from_origin);
      first.start(hn::Max(first.distance(), near));
      second.start(hn::Max(second.distance(), near));
    } else {
      first.start(near);
      second.start(near);
    }
    march();
    keep(&FreeWay::from_near);
  }

  const RayWalk& walk_;
  const RayHits& hits_;
  ConeReach reach_;
  std::size_t ray_count_, count_;
  std::size_t next_ = 0;
  std::array<FreeWay, 2 * kMaxLanes> free_{};
};

/// How many batches go side by side: some compute while others wait for memory.
constexpr std::size_t kSideBySide = 3;

/// Walks all rays, at least as many as a vector has lanes, in batches like `idle`: `start(hits,
/// first, free)` sends one from ray `first` on, of which `free` is known; `step()` takes it on
/// while it `is_active()`; `store(batch)` keeps what it found.
template <class Batch, class Store>
HWY_INLINE void walk_batches(const RayWalk& walk, const RayHits& hits, ConeReach reach,
                             const Batch& idle, const Store& store) {
  BatchQueue queue(walk, hits, reach);
  std::array<Batch, kSideBySide> batches{idle, idle, idle};
  std::size_t running = 0;
  while (running < kSideBySide && !queue.is_empty()) queue.start_next(batches[running++]);
  while (running == kSideBySide) {
    while (std::ranges::all_of(batches, [](const Batch& b) HWY_ATTR { return b.is_active(); })) {
      for (Batch& batch : batches) batch.step();
    }
    // One that has arrived makes room for the next.
    Batch& arrived =
        *std::ranges::find_if_not(batches, [](const Batch& b) HWY_ATTR { return b.is_active(); });
    store(arrived);
    if (queue.is_empty()) {
      arrived = batches[--running];
    } else {
      queue.start_next(arrived);
    }
  }
  for (std::size_t i = 0; i < running; ++i) {
    while (batches[i].is_active()) batches[i].step();
    store(batches[i]);
  }
}

#endif  // HWY_TARGET != HWY_SCALAR
}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
