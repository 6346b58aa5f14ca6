// The vectorised walk through unknown space: one ray a lane, in single precision.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gain/passage_simd.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "gain/ray_batches-inl.hpp"
#include "gain/ray_lanes-inl.hpp"
#include "gain/ray_passages.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR
PassageKernel passage_kernel() { return scalar_passage_kernel(); }
#else

/// The model in voxels.
struct LatticeModel {
  LatticeModel(const RayWalk& walk, const PassageModel& model)
      : voxel_m(static_cast<float>(walk.resolution_m)),
        deep(static_cast<float>(HazardTable::kDeep_m / walk.resolution_m)),
        focal_distance_m(static_cast<float>(model.focal_distance_m)),
        with_uncertainty(model.with_uncertainty) {
    const double origin_m =
        (walk.origin_key.z() - Lattice::kKeyOfOrigin + walk.origin_in_voxel.z()) *
        walk.resolution_m;
    const auto above_origin = [&](double height_m) {
      return static_cast<float>((height_m + model.hazards.floor_map_m() - origin_m) /
                                walk.resolution_m);
    };
    floor_band = above_origin(HazardTable::kFloorBand_m);
    ceiling_band = above_origin(HazardTable::kCeilingBand_m);
    // Beyond all that counts, and finite: 0 times it is 0.
    constexpr double kWall = 1e6;
    for (std::size_t c = 0; c < HazardTable::kContexts; ++c) {
      const double per_voxel = model.hazards.hazard_per_m(c) * walk.resolution_m;
      hazard[c] = static_cast<float>(std::min(per_voxel, kWall));
    }
  }

  float voxel_m;
  float floor_band, ceiling_band;  ///< above the origin
  float deep;
  float focal_distance_m;
  bool with_uncertainty;
  alignas(64) std::array<float, 16> hazard{};  ///< by context, hits a voxel
  static_assert(HazardTable::kContexts <= 16);
};

/// A batch of rays that pass through the unknown.
class PassageBatch : public HitLanes {
 public:
  HWY_INLINE PassageBatch(const RayWalk& walk, const LatticeModel& model)
      : HitLanes(walk), model_(&model) {}

  HWY_INLINE void start(const RayHits& hits, std::size_t first, FreeWay free) {
    set_up(hits, first);
    climb_ = load_demoted(&hits.direction_z[first]);
    begin_ = hn::Set(df, free.from_origin);
    start_at(begin_);
    transmittance_ = hn::Set(df, 1.0F);
    probability_ = u_distance_ = moment1_ = moment2_ = moment3_ = depth_ = hn::Zero(df);
    meets_unknown_ = hn::Not(active_);
  }

  HWY_INLINE void step() {
    // Nothing behind counts any more.
    constexpr float kOpaque = 1e-6F;
    const VecI code = gather_codes();
    const MaskF is_free = hn::RebindMask(df, hn::Lt(code, hn::Set(di, kUnknownCode)));
    const MaskF occupied =
        hn::And(active_, hn::RebindMask(df, hn::Eq(code, hn::Set(di, kOccupiedCode))));
    const CubeExit exit = exit_of_cube(hn::IfThenElseZero(
        is_free,
        hn::Max(hn::Sub(leap_radius_of(code), hn::Set(df, float{kEdgeMargin})), hn::Zero(df))));
    const MaskF is_near = hn::Lt(exit.distance, near_);
    const MaskF arrives = hn::AndNot(is_near, occupied);
    occupied_ = hn::Or(occupied_, arrives);
    if (walk_->rays->near_blocking) {
      blocked_ = hn::Or(blocked_, hn::And(is_near, occupied));
      active_ = hn::AndNot(occupied, active_);
    } else {
      active_ = hn::AndNot(arrives, active_);
    }
    // Where a ray is within the voxel at range_min, it entered by no face.
    entered_axis_ = hn::IfThenZeroElse(hn::RebindMask(di, hn::And(arrives, hn::Le(begin_, near_))),
                                       entered_axis_);

    const MaskF edge =
        hn::RebindMask(df, hn::Ne(hn::And(code, hn::Set(di, kFrontierBit)), hn::Zero(di)));
    const MaskF unknown = hn::And(active_, hn::AndNot(is_free, hn::Not(occupied)));
    const MaskF in_piece = hn::Or(unknown, hn::And(hn::And(active_, is_free), edge));
    if (!hn::AllFalse(df, in_piece)) pass(code, exit.distance, unknown, in_piece, edge);

    active_ = hn::And(active_, hn::And(hn::Lt(exit.distance, far_),
                                       hn::Gt(transmittance_, hn::Set(df, kOpaque))));
    leap(active_, exit, entered_axis_);
    begin_ = hn::IfThenElse(active_, exit.distance, begin_);
  }

  HWY_INLINE void store_all(RayPassages& out) {
    hit_ = occupied_;
    store(out.end);
    const auto put = [&](VecF v, std::vector<float>& to, float unit) HWY_ATTR {
      hn::StoreU(hn::IfThenZeroElse(blocked_, hn::Mul(v, hn::Set(df, unit))), df, &to[first_]);
    };
    const float m = model_->voxel_m;
    put(transmittance_, out.end_probability, 1.0F);
    put(probability_, out.probability, 1.0F);
    put(u_distance_, out.distance_uncertainty, 1.0F);
    put(moment1_, out.moment1_m, m);
    put(moment2_, out.moment2_m2, m * m);
    put(moment3_, out.moment3_m3, m * m * m);
    const hn::Rebind<std::uint8_t, TagI> du8;
    const VecI meets = hn::IfThenElseZero(hn::RebindMask(di, hn::AndNot(blocked_, meets_unknown_)),
                                          hn::Set(di, 1));
    hn::StoreU(hn::DemoteTo(du8, meets), du8, &out.meets_unknown[first_]);
  }

 private:
  /// The lanes `in_piece` come from begin_ to `exit` through a piece.
  HWY_INLINE void pass(VecI code, VecF exit, MaskF unknown, MaskF in_piece, MaskF edge) {
    const VecF whole = hn::Sub(exit, begin_);
    const VecF half = hn::Mul(hn::Set(df, 0.5F), whole);
    const VecF height = hn::Mul(hn::Add(begin_, half), climb_);
    const auto if_then = [](MaskF mask, int value) HWY_ATTR {
      return hn::IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, value));
    };
    // unknown_context() and frontier_context().
    const VecI in_unknown =
        hn::Add(hn::Add(if_then(hn::Ge(height, hn::Set(df, model_->floor_band)), 4),
                        if_then(hn::Ge(height, hn::Set(df, model_->ceiling_band)), 4)),
                hn::Add(if_then(hn::Ge(hn::Add(depth_, half), hn::Set(df, model_->deep)), 2),
                        if_then(edge, 1)));
    const MaskF surface_too = hn::RebindMask(
        df, hn::Ne(hn::And(code, hn::Set(di, kFrontierBesideSurfaceBit)), hn::Zero(di)));
    const VecI in_free = hn::Add(hn::Set(di, static_cast<int>(HazardTable::kUnknownContexts)),
                                 if_then(surface_too, 1));
    const VecI context = hn::IfThenElse(hn::RebindMask(di, unknown), in_unknown, in_free);
    const VecF hazard = hn::GatherIndex(df, model_->hazard.data(), context);
    depth_ = hn::Add(depth_, hn::IfThenElseZero(unknown, whole));

    const VecF end = hn::Min(exit, far_);
    const VecF split = hn::Min(hn::Max(near_, begin_), end);
    const MaskF is_before_near = hn::And(in_piece, hn::Lt(begin_, near_));
    if (!hn::AllFalse(df, is_before_near)) {
      const VecF lost = hn::Expm1(df, hn::Neg(hn::Mul(hazard, hn::Sub(split, begin_))));
      transmittance_ = hn::IfThenElse(
          is_before_near, hn::MulAdd(transmittance_, lost, transmittance_), transmittance_);
    }
    const VecF length = hn::Sub(end, split);
    meets_unknown_ = hn::Or(meets_unknown_, hn::And(unknown, hn::Gt(length, hn::Zero(df))));

    const VecF x = hn::IfThenElseZero(in_piece, hn::Mul(hazard, length));
    const auto [hit, share] = piece_hits(x);
    const VecF s = hn::MulAdd(share, length, split);
    const VecF p = hn::IfThenElseZero(in_piece, hn::Mul(transmittance_, hit));
    if (model_->with_uncertainty) add_uncertainty(p, s);
    probability_ = hn::Add(probability_, p);
    const VecF ps = hn::Mul(p, s);
    const VecF pss = hn::Mul(ps, s);
    moment1_ = hn::Add(moment1_, ps);
    moment2_ = hn::Add(moment2_, pss);
    moment3_ = hn::MulAdd(pss, s, moment3_);
    transmittance_ = hn::Sub(transmittance_, p);
  }

  HWY_INLINE void add_uncertainty(VecF p, VecF s) {
    const VecF one = hn::Set(df, 1.0F);
    const VecF d_focal = hn::Abs(hn::Sub(hn::Mul(s, hn::Set(df, model_->voxel_m)),
                                         hn::Set(df, model_->focal_distance_m)));  // Equation (1)
    const VecF u_distance = hn::Sub(
        one, hn::Div(hn::Set(df, 2.0F), hn::Add(one, hn::Exp(df, d_focal))));  // Equation (2)
    u_distance_ = hn::MulAdd(p, u_distance, u_distance_);
  }

  struct PieceHits {
    VecF probability;
    VecF mean_share;
  };
  /// piece_hit() of x = l L.
  static HWY_INLINE PieceHits piece_hits(VecF x) {
    constexpr float kSeries = 0.25F;  // up to here the terms left out are below rounding
    const auto horner = [&](VecF inner, float c)
                            HWY_ATTR { return hn::MulAdd(x, inner, hn::Set(df, c)); };
    const VecF x2 = hn::Mul(x, x);
    // (1 - exp(-x)) / x and 1 / x - 1 / (exp(x) - 1) by their series.
    const VecF series_hit =
        hn::Mul(x, horner(horner(horner(horner(horner(hn::Set(df, -1.0F / 720.0F), 1.0F / 120.0F),
                                               -1.0F / 24.0F),
                                        1.0F / 6.0F),
                                 -0.5F),
                          1.0F));
    const VecF series_share =
        horner(hn::MulAdd(x2, hn::Set(df, 1.0F / 720.0F), hn::Set(df, -1.0F / 12.0F)), 0.5F);
    const MaskF is_small = hn::Lt(x, hn::Set(df, kSeries));
    if (hn::AllTrue(df, is_small)) return {series_hit, series_share};
    const VecF one = hn::Set(df, 1.0F);
    const VecF minus_hit = hn::Expm1(df, hn::Neg(x));
    // 1 / (exp(x) - 1) is exp(-x) / (1 - exp(-x)).
    const VecF share = hn::Add(hn::Div(one, x), hn::Div(hn::Add(one, minus_hit), minus_hit));
    return {hn::IfThenElse(is_small, series_hit, hn::Neg(minus_hit)),
            hn::IfThenElse(is_small, series_share, share)};
  }

  const LatticeModel* model_;
  VecF climb_;  ///< the directions along z
  VecF begin_;  ///< where the ray entered its voxel
  VecF depth_;  ///< of unknown voxels passed
  VecF transmittance_, probability_, u_distance_, moment1_, moment2_, moment3_;
  MaskF meets_unknown_;
};

void walk_passages(const RayWalk& walk, const PassageModel& passage_model, RayPassages& passages) {
  if (walk.rays->size() < hn::Lanes(df)) {
    scalar_passage_kernel().walk(walk, passage_model, passages);
    return;
  }
  const LatticeModel model(walk, passage_model);
  const auto store = [&](PassageBatch& batch) HWY_ATTR { batch.store_all(passages); };
  walk_batches(walk, passages.end, {.from_origin = true, .margin = kEdgeMargin},
               PassageBatch(walk, model), store);
}

RayBounds passage_bounds(const RayBundle& rays, RayHits& hits) {
  return simd_kernel(HWY_TARGET).rotate_and_bound(rays, hits);
}

PassageKernel passage_kernel() { return {passage_bounds, walk_passages}; }
#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(passage_kernel);

PassageKernel simd_passage_kernel(std::int64_t targets) {
  hwy::ChosenTarget chosen;
  chosen.Update(supported_targets(targets));
  return HWY_DISPATCH_TABLE(passage_kernel)[chosen.GetIndex()]();
}

}  // namespace nbvopt::detail
#endif
