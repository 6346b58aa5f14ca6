// The vectorised ray: one a lane, in single precision within a few hundred voxels of the origin.
// Included once a Highway target, by the files that walk rays.
#if defined(NBVOPT_GAIN_RAY_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NBVOPT_GAIN_RAY_LANES_INL_H
#undef NBVOPT_GAIN_RAY_LANES_INL_H
#else
#define NBVOPT_GAIN_RAY_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "gain/ray_walk.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR
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

/// leap_radius() of free voxels' codes.
HWY_INLINE VecF leap_radius_of(VecI code) {
  return hn::ConvertTo(df, hn::Sub(hn::And(code, hn::Set(di, kLeapMask)), hn::Set(di, 1)));
}

/// One half of a vector of as many floats or integers as a batch has rays.
template <int kHalf>
HWY_INLINE hn::Vec<HalfF> half_of(VecF v) {
  return kHalf == 0 ? hn::LowerHalf(half_f, v) : hn::UpperHalf(half_f, v);
}
template <int kHalf>
HWY_INLINE VecI64 half_of(VecI v) {
  return hn::PromoteTo(di64, kHalf == 0 ? hn::LowerHalf(half_i, v) : hn::UpperHalf(half_i, v));
}

/// Added to a float that is an integer, it leaves that integer in the lower bits: within 2^22 of 0.
constexpr float kToBits = 3 << 22;
/// The bits of kToBits.
constexpr int kBitsOfZero = 0x4B400000;

/// One axis of a batch of rays, mirrored so that all go up; lengths in voxels.
struct Axis {
  VecF direction;
  VecF inverse;
  VecF origin;
  VecF exit_offset;  ///< (1 - origin) / direction
  VecF sign;         ///< -1 where the ray goes down
  VecF bits_offset;  ///< kToBits + the key at voxel 0
  VecF voxel;

  /// `origin_key`: of the voxel that holds the origin.
  HWY_INLINE void set_up(const double* directions, double origin_in_voxel, int origin_key) {
    const VecF d = load_demoted(directions);
    const VecF one = hn::Set(df, 1.0F);
    const MaskF down = hn::Lt(d, hn::Zero(df));
    sign = hn::IfThenElse(down, hn::Neg(one), one);
    // Mirrored, voxel v is -1 - v.
    const VecF at_zero = hn::Set(df, kToBits + static_cast<float>(origin_key));
    bits_offset = hn::IfThenElse(down, hn::Sub(at_zero, one), at_zero);
    direction = hn::Max(hn::Abs(d), hn::Set(df, static_cast<float>(kSmallestDirection)));
    inverse = hn::Div(one, direction);
    origin = hn::Mul(sign, hn::Set(df, static_cast<float>(origin_in_voxel)));
    exit_offset = hn::Mul(hn::Sub(one, origin), inverse);
  }

  HWY_INLINE VecF floor_at(VecF distance) const {
    return hn::Floor(hn::MulAdd(distance, direction, origin));
  }

  /// kBitsOfZero + the voxel's key. One operation, where a conversion that heeds what is no
  /// integer's size takes five.
  HWY_INLINE VecI key_bits() const { return hn::BitCast(di, hn::MulAdd(voxel, sign, bits_offset)); }

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
  HWY_INLINE explicit Lanes(const RayWalk& walk)
      : bricks_(&walk.bricks),
        base_(reinterpret_cast<const std::int64_t*>(walk.bricks.code.front())) {
    place_of_zero_bits_ =
        (kBitsOfZero >> kBrickBits) * (1 + bricks_->size_x * (1 + bricks_->size_y));
  }

 protected:
  /// Takes up rays in these directions, one a lane.
  HWY_INLINE void set_up(const RayWalk& walk, const double* x, const double* y, const double* z) {
    // Keys are counted from the first local brick.
    const BrickKey& min = bricks_->min;
    x_.set_up(x, walk.origin_in_voxel.x(), walk.origin_key.x() - min.x * kBrickSize);
    y_.set_up(y, walk.origin_in_voxel.y(), walk.origin_key.y() - min.y * kBrickSize);
    z_.set_up(z, walk.origin_in_voxel.z(), walk.origin_key.z() - min.z * kBrickSize);
    place_ = hn::Set(di, -1);
    brick_low_ = brick_high_ = hn::Zero(di64);
  }

  HWY_INLINE void place_at(VecF distance) {
    x_.voxel = x_.floor_at(distance);
    y_.voxel = y_.floor_at(distance);
    z_.voxel = z_.floor_at(distance);
  }

  HWY_INLINE VecI gather_codes() {
    const VecI x = x_.key_bits();
    const VecI y = y_.key_bits();
    const VecI z = z_.key_bits();
    const VecI stride_y = hn::Set(di, bricks_->size_x);
    const VecI stride_z = hn::Set(di, bricks_->size_x * bricks_->size_y);
    const VecI place = hn::Add(hn::ShiftRight<kBrickBits>(x),
                               hn::Add(hn::Mul(hn::ShiftRight<kBrickBits>(y), stride_y),
                                       hn::Mul(hn::ShiftRight<kBrickBits>(z), stride_z)));
    if (!hn::AllTrue(di, hn::Eq(place, place_))) {
      place_ = place;
      const auto* codes = reinterpret_cast<const std::int64_t*>(bricks_->code.data());
      const VecI64 base = hn::Set(di64, reinterpret_cast<std::int64_t>(base_));
      const VecI index = hn::Sub(place, hn::Set(di, place_of_zero_bits_));
      brick_low_ = hn::Sub(hn::GatherIndex(di64, codes, half_of<0>(index)), base);
      brick_high_ = hn::Sub(hn::GatherIndex(di64, codes, half_of<1>(index)), base);
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

  /// Where rays leave the cube of a radius around their voxels, and by which face.
  struct CubeExit {
    VecF last_x, last_y, last_z;
    VecF distance;
    MaskF by_x, by_y, by_z;
  };
  HWY_INLINE CubeExit exit_of_cube(VecF radius) const {
    CubeExit exit;
    exit.last_x = hn::Add(x_.voxel, radius);
    exit.last_y = hn::Add(y_.voxel, radius);
    exit.last_z = hn::Add(z_.voxel, radius);
    const VecF exit_x = x_.exit_of(exit.last_x);
    const VecF exit_y = y_.exit_of(exit.last_y);
    const VecF exit_z = z_.exit_of(exit.last_z);
    exit.distance = hn::Min(exit_x, hn::Min(exit_y, exit_z));
    exit.by_x = hn::Le(exit_x, exit.distance);
    exit.by_y = hn::AndNot(exit.by_x, hn::Le(exit_y, exit.distance));
    exit.by_z = hn::Not(hn::Or(exit.by_x, exit.by_y));
    return exit;
  }

  /// Takes the lanes behind the faces, and remembers by which axis they went.
  HWY_INLINE void leap(MaskF leaps, const CubeExit& exit, VecI& entered_axis) {
    x_.leap(leaps, exit.by_x, exit.last_x, exit.distance);
    y_.leap(leaps, exit.by_y, exit.last_y, exit.distance);
    z_.leap(leaps, exit.by_z, exit.last_z, exit.distance);
    const VecI axis = hn::IfThenElse(
        hn::RebindMask(di, exit.by_x), hn::Set(di, 1),
        hn::IfThenElse(hn::RebindMask(di, exit.by_y), hn::Set(di, 2), hn::Set(di, 3)));
    entered_axis = hn::IfThenElse(hn::RebindMask(di, leaps), axis, entered_axis);
  }

  Axis x_, y_, z_;

 private:
  /// Eight bytes at each offset from base_; the first is the code.
  HWY_INLINE VecI64 gather(VecI64 offset) const { return hn::GatherOffset(di64, base_, offset); }

  const LocalBricks* bricks_;
  const std::int64_t* base_;       ///< any brick's codes
  int place_of_zero_bits_;         ///< what bits of keys have more than keys
  VecI place_;                     ///< of the lanes' bricks in the local table, by bits of keys
  VecI64 brick_low_, brick_high_;  ///< their codes, as offsets from base_
};

/// A batch of rays and what they met so far.
class HitLanes : public Lanes {
 public:
  HWY_INLINE explicit HitLanes(const RayWalk& walk) : Lanes(walk), walk_(&walk) {}

  HWY_INLINE bool is_active() const { return !hn::AllFalse(df, active_); }

  HWY_INLINE void store(RayHits& hits) const;

 protected:
  /// Takes up the rays from `first` on; where they start is left to say.
  HWY_INLINE void set_up(const RayHits& hits, std::size_t first) {
    Lanes::set_up(*walk_, &hits.direction_x[first], &hits.direction_y[first],
                  &hits.direction_z[first]);
    first_ = first;
    const VecF scale = hn::Set(df, static_cast<float>(1.0 / walk_->resolution_m));
    near_ = hn::Mul(load_demoted(&walk_->rays->range_min_m[first]), scale);
    far_ = hn::Mul(load_demoted(&walk_->rays->range_max_m[first]), scale);
    active_ = hn::FirstN(df, hn::Lanes(df));
    blocked_ = hit_ = occupied_ = hn::Not(active_);
    entered_axis_ = hn::Zero(di);
  }

  HWY_INLINE void start_at(VecF distance) {
    place_at(distance);
    entered_axis_ = hn::Zero(di);
  }

  const RayWalk* walk_;
  std::size_t first_ = 0;
  VecF near_, far_;
  MaskF active_, hit_, occupied_, blocked_;
  VecI entered_axis_;  ///< 1, 2, 3: by a face along x, y, z; 0: the ray starts in the voxel

 private:
  template <int kHalf>
  HWY_INLINE void store_distances(RayHits& hits) const;
};

/// The way along an axis from the origin to the voxel's face, over a direction: a quotient that is
/// yet to be divided.
struct EntryDistance {
  VecD way, direction;
};

/// To where rays enter the voxel's face along this axis, metres.
template <int kHalf>
HWY_INLINE EntryDistance entry_distance(const Axis& axis, const double* direction,
                                        double origin_in_voxel, double resolution_m) {
  const VecD d = hn::LoadU(dd, direction);
  const VecD o = hn::Set(dd, origin_in_voxel);
  const VecD origin = hn::IfThenElse(hn::Lt(d, hn::Zero(dd)), hn::Neg(o), o);
  const VecD up = hn::Max(hn::Abs(d), hn::Set(dd, kSmallestDirection));
  const VecD voxel = hn::PromoteTo(dd, half_of<kHalf>(axis.voxel));
  return {hn::Mul(hn::Sub(voxel, origin), hn::Set(dd, resolution_m)), up};
}

template <int kHalf>
HWY_INLINE void HitLanes::store_distances(RayHits& hits) const {
  const std::size_t i = first_ + kHalf * hn::Lanes(dd);
  const VecI64 axis = half_of<kHalf>(entered_axis_);
  const Eigen::Vector3d& o = walk_->origin_in_voxel;
  const double r = walk_->resolution_m;
  const VecD near = hn::LoadU(dd, &walk_->rays->range_min_m[i]);
  const VecD far = hn::LoadU(dd, &walk_->rays->range_max_m[i]);
  EntryDistance entry{near, hn::Set(dd, 1.0)};
  const auto take_by = [&](std::int64_t a, EntryDistance by_axis) HWY_ATTR {
    const auto mask = hn::RebindMask(dd, hn::Eq(axis, hn::Set(di64, a)));
    entry.way = hn::IfThenElse(mask, by_axis.way, entry.way);
    entry.direction = hn::IfThenElse(mask, by_axis.direction, entry.direction);
  };
  take_by(1, entry_distance<kHalf>(x_, &hits.direction_x[i], o.x(), r));
  take_by(2, entry_distance<kHalf>(y_, &hits.direction_y[i], o.y(), r));
  take_by(3, entry_distance<kHalf>(z_, &hits.direction_z[i], o.z(), r));
  const VecD distance = hn::Div(entry.way, entry.direction);
  const VecI64 hit = half_of<kHalf>(hn::VecFromMask(di, hn::RebindMask(di, hit_)));
  const auto is_hit = hn::RebindMask(dd, hn::Ne(hit, hn::Zero(di64)));
  hn::StoreU(hn::IfThenElse(is_hit, hn::Max(near, distance), far), dd, &hits.distance_m[i]);
}

HWY_INLINE void HitLanes::store(RayHits& hits) const {
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
  const auto down_if = [&](int axis, VecF sign) HWY_ATTR {
    const VecI down = hn::VecFromMask(di, hn::RebindMask(di, hn::Lt(sign, hn::Zero(df))));
    return hn::IfThenElseZero(hn::Eq(entered_axis_, hn::Set(di, axis)), down);
  };
  const VecI down = hn::Or(down_if(1, x_.sign), hn::Or(down_if(2, y_.sign), down_if(3, z_.sign)));
  const VecI face = hn::Max(
      hn::Zero(di), hn::Sub(hn::Sub(hn::Add(entered_axis_, entered_axis_), hn::Set(di, 1)), down));

  const hn::Rebind<std::uint8_t, TagI> du8;
  const auto if_hit = [&](VecI v)
                          HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(di, hit_), v); };
  hn::StoreU(hn::DemoteTo(du8, kind), du8, reinterpret_cast<std::uint8_t*>(&hits.kind[first_]));
  hn::StoreU(hn::DemoteTo(du8, if_hit(face)), du8,
             reinterpret_cast<std::uint8_t*>(&hits.face[first_]));

  const hn::Rebind<std::uint16_t, TagI> du16;
  const auto key = [&](const Axis& axis, int first_brick) HWY_ATTR {
    const VecI k = hn::Add(axis.key_bits(), hn::Set(di, first_brick * kBrickSize - kBitsOfZero));
    return hn::DemoteTo(du16, hn::And(if_hit(k), hn::Set(di, 0xFFFF)));
  };
  const BrickKey& min = walk_->bricks.min;
  hn::StoreInterleaved3(key(x_, min.x), key(y_, min.y), key(z_, min.z), du16,
                        &hits.voxel[first_].x);

  const auto none_stored = static_cast<float>(walk_->occupied_uncertainty);
  hn::StoreU(hn::IfThenElse(occupied_, hn::Set(df, none_stored), hn::Set(df, kUnknownUncertainty)),
             df, &hits.uncertainty[first_]);
  if (!walk_->look_up_uncertainty) return;
  for (std::size_t i = first_; i < first_ + hn::Lanes(df); ++i) {
    if (hits.kind[i] != HitKind::occupied) continue;
    const Brick* brick = walk_->bricks.brick[walk_->bricks.place_of(brick_of(hits.voxel[i]))];
    hits.uncertainty[i] = brick->states->uncertainty_of_occupied(hits.voxel[i], none_stored);
  }
}

static_assert(sizeof(VoxelKey) == 3 * sizeof(std::uint16_t));
static_assert(sizeof(HitKind) == 1 && sizeof(Face) == 1);
#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
