#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gain/ray_gains.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <array>

#include "gain/ray_gains.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using TagD = hn::ScalableTag<double>;
using VecD = hn::Vec<TagD>;
constexpr TagD dd;
constexpr hn::Rebind<float, TagD> df;
constexpr hn::Rebind<std::int32_t, TagD> di;
constexpr hn::Rebind<std::int64_t, TagD> di64;
constexpr hn::Rebind<std::uint8_t, TagD> du8;
static_assert(sizeof(HitKind) == 1);

/// The sums of a view while its rays go by.
struct Sums {
  VecD unknown_gain;
  VecD occupied_gain;
  std::size_t unknown_rays;
  std::size_t occupied_rays;
};

/// One vector of rays.
HWY_INLINE void add_rays(const RayGainModel& model, const HitKind* kind, const double* distance_m,
                         const float* u_old, const double* angle_part, double* ray_gain,
                         Sums& sums) {
  const VecD one = hn::Set(dd, 1.0);
  const VecD d_focal = hn::Abs(
      hn::Sub(hn::LoadU(dd, distance_m), hn::Set(dd, model.focal_distance_m)));  // Equation (1)
  const VecD u_distance =
      hn::Sub(one, hn::Div(hn::Set(dd, 2.0), hn::Add(one, hn::Exp(dd, d_focal))));  // Equation (2)
  const VecD u_new = hn::MulAdd(hn::Set(dd, model.distance_weight), u_distance,
                                hn::LoadU(dd, angle_part));  // Equation (8)
  // Unknown voxels have u_old = 1, so that one formula serves both.
  const VecD gain = hn::Max(
      hn::Zero(dd), hn::Sub(hn::PromoteTo(dd, hn::LoadU(df, u_old)), u_new));  // Equation (12)

  const auto kinds = hn::PromoteTo(
      di64, hn::PromoteTo(di, hn::LoadU(du8, reinterpret_cast<const std::uint8_t*>(kind))));
  const auto is_kind = [&](HitKind k) HWY_ATTR {
    return hn::RebindMask(dd, hn::Eq(kinds, hn::Set(di64, static_cast<std::int64_t>(k))));
  };
  const auto unknown = is_kind(HitKind::unknown);
  const auto occupied = is_kind(HitKind::occupied);
  sums.unknown_gain = hn::Add(sums.unknown_gain, hn::IfThenElseZero(unknown, gain));
  sums.occupied_gain = hn::Add(sums.occupied_gain, hn::IfThenElseZero(occupied, gain));
  sums.unknown_rays += hn::CountTrue(dd, unknown);
  sums.occupied_rays += hn::CountTrue(dd, occupied);
  hn::StoreU(hn::IfThenElseZero(hn::Or(unknown, occupied), gain), dd, ray_gain);
}

ViewGain view_gain(const RayGainModel& model, const RayHits& hits, double* ray_gain) {
  const std::size_t lanes = hn::Lanes(dd);
  const std::size_t n = hits.size();
  Sums sums{hn::Zero(dd), hn::Zero(dd), 0, 0};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    add_rays(model, &hits.kind[i], &hits.distance_m[i], &hits.uncertainty[i], &model.angle_part[i],
             ray_gain + i, sums);
  }
  if (i < n) {
    // The rest, filled up with rays that hit nothing.
    constexpr std::size_t kMaxLanes = 8;
    std::array<HitKind, kMaxLanes> kind{};
    std::array<double, kMaxLanes> distance{}, angle_part{}, gain{};
    std::array<float, kMaxLanes> u_old{};
    std::copy(hits.kind.begin() + i, hits.kind.end(), kind.begin());
    std::copy(hits.distance_m.begin() + i, hits.distance_m.end(), distance.begin());
    std::copy(hits.uncertainty.begin() + i, hits.uncertainty.end(), u_old.begin());
    std::copy(model.angle_part.begin() + i, model.angle_part.end(), angle_part.begin());
    add_rays(model, kind.data(), distance.data(), u_old.data(), angle_part.data(), gain.data(),
             sums);
    std::copy_n(gain.begin(), n - i, ray_gain + i);
  }
  ViewGain view;
  view.unknown_gain = hn::GetLane(hn::SumOfLanes(dd, sums.unknown_gain));
  view.occupied_gain = hn::GetLane(hn::SumOfLanes(dd, sums.occupied_gain));
  view.gain = view.unknown_gain + view.occupied_gain;  // Equation (13), over rays
  view.unknown_rays = static_cast<int>(sums.unknown_rays);
  view.occupied_rays = static_cast<int>(sums.occupied_rays);
  view.free_rays = static_cast<int>(n) - view.unknown_rays - view.occupied_rays;
  return view;
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(view_gain);

ViewGain ray_gains(const RayGainModel& model, const RayHits& hits, std::vector<double>& ray_gain) {
  ray_gain.resize(hits.size());
  return HWY_DYNAMIC_DISPATCH(view_gain)(model, hits, ray_gain.data());
}

}  // namespace nbvopt::detail
#endif
