// Lanes in either precision: how they are read and written, and functions of their values, with
// derivatives, that are smooth where the gain has corners and edges. Included once a Highway
// target.
#if defined(NBVOPT_GAIN_SMOOTH_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NBVOPT_GAIN_SMOOTH_LANES_INL_H
#undef NBVOPT_GAIN_SMOOTH_LANES_INL_H
#else
#define NBVOPT_GAIN_SMOOTH_LANES_INL_H
#endif

#include <hwy/highway.h>

#include "gain/panorama_sum.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Single = hn::CappedTag<float, HitBlock::kSize>;
using Double = hn::CappedTag<double, HitBlock::kSize>;

/// |x| and the relu are rounded off within this of their corners.
constexpr double kRounding = 0.005;

HWY_INLINE hn::Vec<Single> load(Single d, const float* from) { return hn::LoadU(d, from); }
HWY_INLINE hn::Vec<Double> load(Double d, const float* from) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, Double>(), from));
}

HWY_INLINE void store(Double d, hn::Vec<Double> v, double* to) { hn::StoreU(v, d, to); }
HWY_INLINE hn::Vec<Double> load_term(Double d, const double* from) { return hn::LoadU(d, from); }
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void store(Single, hn::Vec<Single> v, double* to) { *to = double{hn::GetLane(v)}; }
HWY_INLINE hn::Vec<Single> load_term(Single d, const double* from) {
  return hn::Set(d, static_cast<float>(*from));
}
#else
using HalfDouble = hn::Repartition<double, Single>;
using HalfSingle = hn::Half<Single>;
HWY_INLINE void store(Single, hn::Vec<Single> v, double* to) {
  const HalfDouble dd;
  const HalfSingle half;
  hn::StoreU(hn::PromoteTo(dd, hn::LowerHalf(half, v)), dd, to);
  hn::StoreU(hn::PromoteTo(dd, hn::UpperHalf(half, v)), dd, to + hn::Lanes(dd));
}
HWY_INLINE hn::Vec<Single> load_term(Single d, const double* from) {
  const HalfDouble dd;
  const HalfSingle half;
  return hn::Combine(d, hn::DemoteTo(half, hn::LoadU(dd, from + hn::Lanes(dd))),
                     hn::DemoteTo(half, hn::LoadU(dd, from)));
}
#endif

template <class D>
HWY_INLINE hn::Vec<D> set(D d, double value) {
  return hn::Set(d, static_cast<hn::TFromD<D>>(value));
}

template <class D>
HWY_INLINE hn::Vec<D> clamp_to_one(D d, hn::Vec<D> v) {
  return hn::Max(set(d, -1.0), hn::Min(v, set(d, 1.0)));
}

/// A value and its derivative.
template <class D>
struct Slope {
  hn::Vec<D> value;
  hn::Vec<D> slope;
};

/// |x|, a parabola within kRounding of 0.
template <class D>
HWY_INLINE Slope<D> rounded_abs(D d, hn::Vec<D> x) {
  const auto size = hn::Abs(x);
  const auto in = hn::Min(size, set(d, kRounding));
  const auto lift = hn::MulAdd(hn::Mul(in, in), set(d, 0.5 / kRounding), set(d, 0.5 * kRounding));
  return {hn::Add(hn::Sub(size, in), lift), clamp_to_one(d, hn::Mul(x, set(d, 1.0 / kRounding)))};
}

/// max(0, x), a parabola within kRounding of 0.
template <class D>
HWY_INLINE Slope<D> rounded_relu(D d, hn::Vec<D> x) {
  const auto in = clamp_to_one(d, hn::Mul(x, set(d, 1.0 / kRounding)));
  const auto beyond = hn::Max(hn::Sub(x, set(d, kRounding)), hn::Zero(d));
  const auto up = hn::Add(in, set(d, 1.0));
  return {hn::MulAdd(hn::Mul(up, up), set(d, 0.25 * kRounding), beyond), hn::Mul(up, set(d, 0.5))};
}

/// The C2 step from 0 at -1 to 1 at 1 (a quintic); its slope is by t.
template <class D>
HWY_INLINE Slope<D> step(D d, hn::Vec<D> t_unbounded) {
  const auto t = clamp_to_one(d, t_unbounded);
  const auto t2 = hn::Mul(t, t);
  const auto odd =
      hn::MulAdd(t2, hn::MulAdd(t2, set(d, 3.0 / 16.0), set(d, -10.0 / 16.0)), set(d, 15.0 / 16.0));
  const auto rest = hn::Sub(set(d, 1.0), t2);
  return {hn::MulAdd(t, odd, set(d, 0.5)), hn::Mul(hn::Mul(rest, rest), set(d, 15.0 / 16.0))};
}

/// Up to which angle the field of view reaches: the step at its edge, by alpha.
template <class D>
HWY_INLINE Slope<D> edge(D d, hn::Vec<D> alpha, double half_fov_rad, double tau_rad) {
  const auto inside = hn::Mul(hn::Sub(set(d, half_fov_rad), hn::Abs(alpha)), set(d, 1.0 / tau_rad));
  const Slope<D> s = step(d, inside);
  return {s.value, hn::CopySign(hn::Mul(s.slope, set(d, 1.0 / tau_rad)), hn::Neg(alpha))};
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
