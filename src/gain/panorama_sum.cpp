#include "gain/panorama_sum.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gain/panorama_sum.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <cmath>

#include "gain/panorama_terms-inl.hpp"
#include "gain/smooth_lanes-inl.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
double gain(const PanoramaModel& model, const PanoramaView& view, const HitBlock* blocks,
            std::span<const std::uint32_t> ids) {
  const D d;
  auto sum = hn::Zero(d);
  for (const std::uint32_t id : ids) {
    for (std::size_t i = 0; i < HitBlock::kSize; i += hn::Lanes(d)) {
      const Terms<D> terms(d, model, view, blocks[id], i);
      sum = hn::MulAdd(terms.rays, terms.gain, sum);
    }
  }
  return double{hn::GetLane(hn::SumOfLanes(d, sum))};
}

template <class D>
PanoramaSum gain_and_motion(const PanoramaModel& model, const PanoramaView& view,
                            const HitBlock* blocks, std::span<const std::uint32_t> ids) {
  const D d;
  auto sum = hn::Zero(d);
  MotionLanes<D> motion(d);
  for (const std::uint32_t id : ids) {
    for (std::size_t i = 0; i < HitBlock::kSize; i += hn::Lanes(d)) {
      const Terms<D> terms(d, model, view, blocks[id], i);
      sum = hn::MulAdd(terms.rays, terms.gain, sum);
      terms.add_motion(d, terms.gain, terms.rays, motion);
    }
  }
  PanoramaSum result;
  result.gain = double{hn::GetLane(hn::SumOfLanes(d, sum))};
  motion.write(d, view, result);
  return result;
}

template <class D>
void hit_terms(const PanoramaModel& model, const PanoramaView& view, const HitBlock* blocks,
               std::span<const std::uint32_t> ids, HitTerms& terms) {
  const D d;
  terms.resize(ids.size());
  std::size_t next = 0;
  for (const std::uint32_t id : ids) {
    for (std::size_t i = 0; i < HitBlock::kSize; i += hn::Lanes(d), next += hn::Lanes(d)) {
      const Terms<D> hit(d, model, view, blocks[id], i);
      store(d, hit.rays, &terms.rays[next]);
      store(d, hit.gain, &terms.gain[next]);
    }
  }
}

template <class D>
PanoramaSum motion_of(const PanoramaModel& model, const PanoramaView& view, const HitBlock* blocks,
                      std::span<const std::uint32_t> ids, const HitTerms& by_term) {
  const D d;
  MotionLanes<D> motion(d);
  std::size_t next = 0;
  for (const std::uint32_t id : ids) {
    for (std::size_t i = 0; i < HitBlock::kSize; i += hn::Lanes(d), next += hn::Lanes(d)) {
      const Terms<D> hit(d, model, view, blocks[id], i);
      hit.add_motion(d, load_term(d, &by_term.rays[next]), load_term(d, &by_term.gain[next]),
                     motion);
    }
  }
  PanoramaSum result;
  motion.write(d, view, result);
  return result;
}

template <class D>
PanoramaKernel kernel_of() {
  return {gain<D>, gain_and_motion<D>, hit_terms<D>, motion_of<D>};
}

PanoramaKernel kernel(bool double_precision) {
  return double_precision ? kernel_of<Double>() : kernel_of<Single>();
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(kernel);

PanoramaModel::PanoramaModel(const SensorOptions& sensor, double resolution_m)
    : focal_distance_m(sensor.focal_distance_m),
      range_min_m(sensor.range_min_m),
      far_gate_m(sensor.range_max_m + 0.5 * resolution_m),
      far_gate_half_width_m(0.5 * resolution_m),
      equal_angles(sensor.ray_pattern == RayPattern::equal_angles),
      z_depth(sensor.range_axis == RangeAxis::z_depth) {
  const int n_h = sensor.horizontal_rays;
  const int n_v = sensor.vertical_rays;
  // Rays from edge to edge stand for cells that reach half a spacing further.
  const auto cells = [&](double half_fov_rad, int n) {
    return equal_angles && n > 1 ? half_fov_rad * n / (n - 1) : half_fov_rad;
  };
  half_fov_h_rad = cells(sensor.half_fov_horizontal_rad, n_h);
  half_fov_v_rad = cells(sensor.half_fov_vertical_rad, n_v);
  ray_spacing_h_rad = 2.0 * half_fov_h_rad / n_h;
  ray_spacing_v_rad = 2.0 * half_fov_v_rad / n_v;
  density = equal_angles ? n_h * n_v / (4.0 * half_fov_h_rad * half_fov_v_rad)
                         : n_h * n_v / (4.0 * std::tan(half_fov_h_rad) * std::tan(half_fov_v_rad));
  const UncertaintyModel uncertainty(sensor);
  weight_distance = uncertainty.distance_weight();
  weight_h_per_rad = uncertainty.horizontal_weight_per_rad();
  weight_v_per_rad = uncertainty.vertical_weight_per_rad();
}

PanoramaKernel panorama_kernel(bool double_precision) {
  return HWY_DYNAMIC_DISPATCH(kernel)(double_precision);
}

}  // namespace nbvopt::detail
#endif
