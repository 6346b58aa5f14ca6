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

#include "gain/ray_walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR
CasterKernel kernel() { return scalar_kernel(); }
#else
namespace hn = hwy::HWY_NAMESPACE;

using TagF = hn::ScalableTag<float>;
using TagI = hn::RebindToSigned<TagF>;
using TagD = hn::Repartition<double, TagF>;  // half as many lanes
using TagI64 = hn::Repartition<std::int64_t, TagF>;
using HalfF = hn::Rebind<float, TagD>;
using HalfI = hn::Rebind<std::int32_t, TagD>;
using VecF = hn::Vec<TagF>;
using VecI = hn::Vec<TagI>;
using VecD = hn::Vec<TagD>;
using VecI64 = hn::Vec<TagI64>;
using MaskF = hn::Mask<TagF>;

constexpr TagF df;
constexpr TagI di;
constexpr TagD dd;
constexpr TagI64 di64;
constexpr HalfF half_f;
constexpr HalfI half_i;

/// Loads one vector of floats from doubles.
HWY_INLINE VecF load_demoted(const double* from) {
  return hn::Combine(df, hn::DemoteTo(half_f, hn::LoadU(dd, from + hn::Lanes(dd))),
                     hn::DemoteTo(half_f, hn::LoadU(dd, from)));
}

constexpr std::size_t kMaxLanes = 16;

/// One half of a vector of as many floats or integers as a batch has rays.
template <int kHalf>
HWY_INLINE hn::Vec<HalfF> half_of(VecF v) {
  return kHalf == 0 ? hn::LowerHalf(half_f, v) : hn::UpperHalf(half_f, v);
}
template <int kHalf>
HWY_INLINE VecI64 half_of(VecI v) {
  return hn::PromoteTo(di64, kHalf == 0 ? hn::LowerHalf(half_i, v) : hn::UpperHalf(half_i, v));
}

/// One axis of a batch of rays, mirrored so that all go up; lengths in voxels.
struct Axis {
  VecF direction;
  VecF inverse;
  VecF origin;
  VecF exit_offset;  ///< (1 - origin) / direction
  VecI mirror;       ///< -1 where the ray goes down
  VecF voxel;

  HWY_INLINE void set_up(const double* directions, double origin_in_voxel) {
    const VecF d = load_demoted(directions);
    const MaskF down = hn::Lt(d, hn::Zero(df));
    mirror = hn::IfThenElseZero(hn::RebindMask(di, down), hn::Set(di, -1));
    direction = hn::Max(hn::Abs(d), hn::Set(df, static_cast<float>(kSmallestDirection)));
    inverse = hn::Div(hn::Set(df, 1.0F), direction);
    const VecF o = hn::Set(df, static_cast<float>(origin_in_voxel));
    origin = hn::IfThenElse(down, hn::Neg(o), o);
    exit_offset = hn::Mul(hn::Sub(hn::Set(df, 1.0F), origin), inverse);
  }

  HWY_INLINE VecF floor_at(VecF distance) const {
    return hn::Floor(hn::MulAdd(distance, direction, origin));
  }

  /// The voxel's key.
  HWY_INLINE VecI key(int origin_key) const {
    return hn::Add(hn::Xor(hn::ConvertTo(di, voxel), mirror), hn::Set(di, origin_key));
  }

  /// Where the ray leaves `last`, the farthest voxel of the cube.
  HWY_INLINE VecF exit_of(VecF last) const { return hn::MulAdd(last, inverse, exit_offset); }

  /// The voxel behind the cube's face where the ray leaves by it; elsewhere the one that holds the
  /// point, which rounding must not take out of the cube.
  HWY_INLINE void leap(MaskF active, MaskF leaves, VecF last, VecF distance) {
    const VecF inside = hn::Min(hn::Max(floor_at(distance), voxel), last);
    const VecF next = hn::IfThenElse(leaves, hn::Add(last, hn::Set(df, 1.0F)), inside);
    voxel = hn::IfThenElse(active, next, voxel);
  }
};

/// As many mirrored rays as a vector has lanes, and the codes of the voxels that they are in.
class Lanes {
 public:
  HWY_INLINE Lanes(const RayWalk& walk, const double* x, const double* y, const double* z)
      : bricks_(walk.bricks),
        base_(reinterpret_cast<const std::int64_t*>(walk.bricks.code.front())) {
    x_.set_up(x, walk.origin_in_voxel.x());
    y_.set_up(y, walk.origin_in_voxel.y());
    z_.set_up(z, walk.origin_in_voxel.z());
    // Counted from the first local brick.
    key_x_ = walk.origin_key.x() - bricks_.min.x * kBrickSize;
    key_y_ = walk.origin_key.y() - bricks_.min.y * kBrickSize;
    key_z_ = walk.origin_key.z() - bricks_.min.z * kBrickSize;
    place_ = hn::Set(di, -1);
    brick_low_ = brick_high_ = hn::Zero(di64);
  }

 protected:
  HWY_INLINE void place_at(VecF distance) {
    x_.voxel = x_.floor_at(distance);
    y_.voxel = y_.floor_at(distance);
    z_.voxel = z_.floor_at(distance);
  }

  HWY_INLINE VecI gather_codes() {
    const VecI x = x_.key(key_x_);
    const VecI y = y_.key(key_y_);
    const VecI z = z_.key(key_z_);
    const VecI stride_y = hn::Set(di, bricks_.size_x);
    const VecI stride_z = hn::Set(di, bricks_.size_x * bricks_.size_y);
    const VecI place = hn::Add(hn::ShiftRight<kBrickBits>(x),
                               hn::Add(hn::Mul(hn::ShiftRight<kBrickBits>(y), stride_y),
                                       hn::Mul(hn::ShiftRight<kBrickBits>(z), stride_z)));
    if (!hn::AllTrue(di, hn::Eq(place, place_))) {
      place_ = place;
      const auto* codes = reinterpret_cast<const std::int64_t*>(bricks_.code.data());
      const VecI64 base = hn::Set(di64, reinterpret_cast<std::int64_t>(base_));
      brick_low_ = hn::Sub(hn::GatherIndex(di64, codes, half_of<0>(place)), base);
      brick_high_ = hn::Sub(hn::GatherIndex(di64, codes, half_of<1>(place)), base);
    }
    // code_index().
    const VecI low_bits = hn::Set(di, 3);
    const VecI high_bits = hn::Set(di, kBrickMask & ~3);
    const VecI in_cube = hn::Or(
        hn::And(x, low_bits),
        hn::Or(hn::ShiftLeft<2>(hn::And(y, low_bits)), hn::ShiftLeft<4>(hn::And(z, low_bits))));
    const VecI cube = hn::Or(
        hn::ShiftLeft<4>(hn::And(x, high_bits)),
        hn::Or(hn::ShiftLeft<7>(hn::And(y, high_bits)), hn::ShiftLeft<10>(hn::And(z, high_bits))));
    const VecI index = hn::Or(in_cube, cube);
    const VecI64 low = gather(hn::Add(brick_low_, half_of<0>(index)));
    const VecI64 high = gather(hn::Add(brick_high_, half_of<1>(index)));
    const hn::RebindToUnsigned<HalfI> half_u;
    const hn::RebindToUnsigned<TagI64> du64;
    const auto both =
        hn::Combine(hn::RebindToUnsigned<TagI>(), hn::TruncateTo(half_u, hn::BitCast(du64, high)),
                    hn::TruncateTo(half_u, hn::BitCast(du64, low)));
    return hn::And(hn::BitCast(di, both), hn::Set(di, 0xFF));
  }

  Axis x_, y_, z_;

 private:
  /// Eight bytes at each offset from base_; the first is the code.
  HWY_INLINE VecI64 gather(VecI64 offset) const { return hn::GatherOffset(di64, base_, offset); }

  const LocalBricks& bricks_;
  const std::int64_t* base_;       ///< any brick's codes
  VecI place_;                     ///< of the lanes' bricks in the local table
  VecI64 brick_low_, brick_high_;  ///< their codes, as offsets from base_
  int key_x_, key_y_, key_z_;
};

/// Cones, one a batch of rays: an axis, and by how much the rays' directions differ from it along
/// any coordinate. A cone that lies in cubes of free voxels takes its whole batch forward.
struct ConeGroup {
  alignas(64) std::array<double, kMaxLanes> x{}, y{}, z{};
  alignas(64) std::array<float, kMaxLanes> spread{}, begin{}, end{};

  /// The cone around the rays from `first` on.
  HWY_INLINE void set(std::size_t cone, const RayWalk& walk, const RayHits& hits,
                      std::size_t first) {
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
        scale * hn::GetLane(hn::MinOfLanes(df, load_demoted(&walk.rays->range_min_m[first])));
    end[cone] =
        scale * hn::GetLane(hn::MinOfLanes(df, load_demoted(&walk.rays->range_max_m[first])));
  }
};

/// Walks cones.
class ConeLanes : public Lanes {
 public:
  HWY_INLINE ConeLanes(const RayWalk& walk, const ConeGroup& cones)
      : Lanes(walk, cones.x.data(), cones.y.data(), cones.z.data()),
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
      const VecF radius = hn::Sub(hn::ConvertTo(df, code), hn::Set(df, 1.0F + kRounding));
      const VecF leap = hn::Mul(hn::NegMulAdd(distance_, spread_, radius), per_voxel);
      active = hn::And(hn::And(active, is_free), hn::Ge(leap, hn::Set(df, kWorthwhile)));
      distance_ = hn::IfThenElse(active, hn::Min(hn::Add(distance_, leap), end_), distance_);
      active = hn::And(active, hn::Lt(distance_, end_));
    }
    return distance_;
  }

 private:
  VecF spread_, distance_, end_;
};

/// A batch of rays on their way to what they hit.
class Batch : public Lanes {
 public:
  HWY_INLINE Batch(const RayWalk& walk, const RayHits& hits, std::size_t first)
      : Lanes(walk, &hits.direction_x[first], &hits.direction_y[first], &hits.direction_z[first]),
        walk_(walk),
        first_(first) {
    const VecF scale = hn::Set(df, static_cast<float>(1.0 / walk.resolution_m));
    near_ = hn::Mul(load_demoted(&walk.rays->range_min_m[first]), scale);
    far_ = hn::Mul(load_demoted(&walk.rays->range_max_m[first]), scale);
    active_ = hn::FirstN(df, hn::Lanes(df));
    blocked_ = hit_ = occupied_ = hn::Not(active_);
  }

  /// Marks the rays that an occupied voxel, left before range_min, blocks.
  HWY_INLINE void walk_near() {
    start_at(hn::Zero(df));
    while (is_active()) {
      const VecI code = gather_codes();
      const MaskF occupied = hn::RebindMask(df, hn::Eq(code, hn::Set(di, kOccupiedCode)));
      // Unknown voxels there are passed one by one.
      const MaskF is_free = hn::RebindMask(df, hn::Lt(code, hn::Set(di, kUnknownCode)));
      const VecF radius =
          hn::IfThenElseZero(is_free, hn::Sub(hn::ConvertTo(df, code), hn::Set(df, 1.0F)));
      const MaskF before_near = leap_where(active_, radius, near_, occupied);
      blocked_ = hn::Or(blocked_, hn::And(before_near, occupied));
      active_ = hn::AndNot(occupied, before_near);
    }
    active_ = hn::Not(blocked_);
  }

  /// Starts at range_min, or farther where all before is known to be free.
  HWY_INLINE void start_beyond(float free_up_to) {
    start_at(hn::Max(near_, hn::Set(df, free_up_to)));
  }

  HWY_INLINE bool is_active() const { return !hn::AllFalse(df, active_); }

  /// Takes every active ray behind the cube that its code speaks for.
  HWY_INLINE void step() {
    const VecI code = gather_codes();
    const MaskF stopped = hn::RebindMask(df, hn::Gt(code, hn::Set(di, kUnknownCode - 1)));
    const VecF radius = hn::Sub(hn::ConvertTo(df, code), hn::Set(df, 1.0F));
    const MaskF hit = hn::And(active_, stopped);
    hit_ = hn::Or(hit_, hit);
    occupied_ = hn::Or(occupied_,
                       hn::And(hit, hn::RebindMask(df, hn::Eq(code, hn::Set(di, kOccupiedCode)))));
    active_ = leap_where(hn::AndNot(stopped, active_), radius, far_, stopped);
  }

  HWY_INLINE void store(RayHits& hits) const;

 private:
  template <int kHalf>
  HWY_INLINE void store_distances(RayHits& hits) const;

  HWY_INLINE void start_at(VecF distance) {
    place_at(distance);
    entered_axis_ = hn::Zero(di);
  }

  /// Of the `candidates`, those that leave their cube before `end` are returned, and, but for the
  /// `frozen`, leap behind its surface.
  HWY_INLINE MaskF leap_where(MaskF candidates, VecF radius, VecF end, MaskF frozen) {
    const VecF last_x = hn::Add(x_.voxel, radius);
    const VecF last_y = hn::Add(y_.voxel, radius);
    const VecF last_z = hn::Add(z_.voxel, radius);
    const VecF exit_x = x_.exit_of(last_x);
    const VecF exit_y = y_.exit_of(last_y);
    const VecF exit_z = z_.exit_of(last_z);
    const VecF distance = hn::Min(exit_x, hn::Min(exit_y, exit_z));
    const MaskF before_end = hn::And(candidates, hn::Lt(distance, end));
    const MaskF leaps = hn::AndNot(frozen, before_end);
    const MaskF by_x = hn::Le(exit_x, distance);
    const MaskF by_y = hn::AndNot(by_x, hn::Le(exit_y, distance));
    const MaskF by_z = hn::Not(hn::Or(by_x, by_y));
    x_.leap(leaps, by_x, last_x, distance);
    y_.leap(leaps, by_y, last_y, distance);
    z_.leap(leaps, by_z, last_z, distance);
    const VecI axis =
        hn::IfThenElse(hn::RebindMask(di, by_x), hn::Set(di, 1),
                       hn::IfThenElse(hn::RebindMask(di, by_y), hn::Set(di, 2), hn::Set(di, 3)));
    entered_axis_ = hn::IfThenElse(hn::RebindMask(di, leaps), axis, entered_axis_);
    return before_end;
  }

  const RayWalk& walk_;
  std::size_t first_;
  VecF near_, far_;
  MaskF active_, hit_, occupied_, blocked_;
  VecI entered_axis_;  ///< 1, 2, 3: by a face along x, y, z; 0: the ray starts in the voxel
};

/// Where rays enter the voxel's face along this axis, metres.
template <int kHalf>
HWY_INLINE VecD entry_distance(const Axis& axis, const double* direction, double origin_in_voxel,
                               double resolution_m) {
  const VecD d = hn::LoadU(dd, direction);
  const VecD o = hn::Set(dd, origin_in_voxel);
  const VecD origin = hn::IfThenElse(hn::Lt(d, hn::Zero(dd)), hn::Neg(o), o);
  const VecD up = hn::Max(hn::Abs(d), hn::Set(dd, kSmallestDirection));
  const VecD voxel = hn::PromoteTo(dd, half_of<kHalf>(axis.voxel));
  return hn::Div(hn::Mul(hn::Sub(voxel, origin), hn::Set(dd, resolution_m)), up);
}

template <int kHalf>
HWY_INLINE void Batch::store_distances(RayHits& hits) const {
  const std::size_t i = first_ + kHalf * hn::Lanes(dd);
  const VecI64 axis = half_of<kHalf>(entered_axis_);
  const Eigen::Vector3d& o = walk_.origin_in_voxel;
  const double r = walk_.resolution_m;
  const auto by = [&](std::int64_t a)
                      HWY_ATTR { return hn::RebindMask(dd, hn::Eq(axis, hn::Set(di64, a))); };
  const VecD near = hn::LoadU(dd, &walk_.rays->range_min_m[i]);
  const VecD far = hn::LoadU(dd, &walk_.rays->range_max_m[i]);
  VecD distance = near;
  distance =
      hn::IfThenElse(by(1), entry_distance<kHalf>(x_, &hits.direction_x[i], o.x(), r), distance);
  distance =
      hn::IfThenElse(by(2), entry_distance<kHalf>(y_, &hits.direction_y[i], o.y(), r), distance);
  distance =
      hn::IfThenElse(by(3), entry_distance<kHalf>(z_, &hits.direction_z[i], o.z(), r), distance);
  const VecI64 hit = half_of<kHalf>(hn::VecFromMask(di, hn::RebindMask(di, hit_)));
  const auto is_hit = hn::RebindMask(dd, hn::Ne(hit, hn::Zero(di64)));
  hn::StoreU(hn::IfThenElse(is_hit, hn::Max(near, distance), far), dd, &hits.distance_m[i]);
}

HWY_INLINE void Batch::store(RayHits& hits) const {
  store_distances<0>(hits);
  store_distances<1>(hits);

  // Kinds as numbers of HitKind; a ray that hits nothing keeps none.
  VecI kind =
      hn::IfThenElseZero(hn::RebindMask(di, hit_), hn::Set(di, static_cast<int>(HitKind::unknown)));
  kind = hn::IfThenElse(hn::RebindMask(di, occupied_),
                        hn::Set(di, static_cast<int>(HitKind::occupied)), kind);
  kind = hn::IfThenElse(hn::RebindMask(di, blocked_),
                        hn::Set(di, static_cast<int>(HitKind::blocked)), kind);
  // Faces as numbers of Face: 1 + 2 * axis, one more where the ray goes down.
  const auto mirror_if = [&](int axis, VecI mirror) HWY_ATTR {
    return hn::IfThenElseZero(hn::Eq(entered_axis_, hn::Set(di, axis)), mirror);
  };
  const VecI mirror =
      hn::Or(mirror_if(1, x_.mirror), hn::Or(mirror_if(2, y_.mirror), mirror_if(3, z_.mirror)));
  const VecI face =
      hn::Max(hn::Zero(di),
              hn::Sub(hn::Sub(hn::Add(entered_axis_, entered_axis_), hn::Set(di, 1)), mirror));

  const hn::Rebind<std::uint8_t, TagI> du8;
  const auto if_hit = [&](VecI v)
                          HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(di, hit_), v); };
  hn::StoreU(hn::DemoteTo(du8, kind), du8, reinterpret_cast<std::uint8_t*>(&hits.kind[first_]));
  hn::StoreU(hn::DemoteTo(du8, if_hit(face)), du8,
             reinterpret_cast<std::uint8_t*>(&hits.face[first_]));

  const hn::Rebind<std::uint16_t, TagI> du16;
  const auto key = [&](const Axis& axis, int origin_key) HWY_ATTR {
    return hn::DemoteTo(du16, hn::And(if_hit(axis.key(origin_key)), hn::Set(di, 0xFFFF)));
  };
  hn::StoreInterleaved3(key(x_, walk_.origin_key.x()), key(y_, walk_.origin_key.y()),
                        key(z_, walk_.origin_key.z()), du16, &hits.voxel[first_].x);

  const auto none_stored = static_cast<float>(walk_.occupied_uncertainty);
  hn::StoreU(hn::IfThenElse(occupied_, hn::Set(df, none_stored), hn::Set(df, kUnknownUncertainty)),
             df, &hits.uncertainty[first_]);
  if (!walk_.look_up_uncertainty) return;
  for (std::size_t i = first_; i < first_ + hn::Lanes(df); ++i) {
    if (hits.kind[i] != HitKind::occupied) continue;
    const Brick* brick = walk_.bricks.brick[walk_.bricks.place_of(brick_of(hits.voxel[i]))];
    hits.uncertainty[i] = brick->states->uncertainty_of_occupied(hits.voxel[i], none_stored);
  }
}

static_assert(sizeof(VoxelKey) == 3 * sizeof(std::uint16_t));
static_assert(sizeof(HitKind) == 1 && sizeof(Face) == 1);

void walk_rays(const RayWalk& walk, RayHits& hits) {
  const std::size_t lanes = hn::Lanes(df);
  const std::size_t n = walk.rays->size();
  if (n < lanes) {
    scalar_kernel().walk(walk, hits);
    return;
  }
  const std::size_t batches = (n + lanes - 1) / lanes;
  const auto first_ray = [&](std::size_t batch) {
    return std::min(batch * lanes, n - lanes);  // the last batch may overlap
  };
  ConeGroup cones;
  for (std::size_t group = 0; group < batches; group += lanes) {
    const std::size_t group_size = std::min(lanes, batches - group);
    for (std::size_t c = 0; c < lanes; ++c) {
      cones.set(c, walk, hits, first_ray(group + std::min(c, group_size - 1)));
    }
    alignas(64) std::array<float, kMaxLanes> free_up_to;
    hn::Store(ConeLanes(walk, cones).march(), df, free_up_to.data());
    for (std::size_t c = 0; c < group_size; c += 2) {
      // Two batches side by side: one computes while the other waits for memory.
      const std::size_t d = std::min(c + 1, group_size - 1);
      Batch first(walk, hits, first_ray(group + c));
      Batch second(walk, hits, first_ray(group + d));
      if (walk.walk_near) {
        first.walk_near();
        second.walk_near();
      }
      first.start_beyond(free_up_to[c]);
      second.start_beyond(free_up_to[d]);
      while (first.is_active() || second.is_active()) {
        first.step();
        second.step();
      }
      first.store(hits);
      second.store(hits);
    }
  }
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
  // Asking the processor takes microseconds on a virtual machine.
  static const std::int64_t supported = hwy::SupportedTargets();
  hwy::ChosenTarget chosen;
  chosen.Update(targets == 0 ? supported : targets & supported);
  return HWY_DISPATCH_TABLE(kernel)[chosen.GetIndex()]();
}

}  // namespace nbvopt::detail
#endif
