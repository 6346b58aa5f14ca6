// What single hits of a panorama add to a view's gain, and how that changes as the camera moves.
// Included once a Highway target.
#if defined(NBVOPT_GAIN_PANORAMA_TERMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef NBVOPT_GAIN_PANORAMA_TERMS_INL_H
#undef NBVOPT_GAIN_PANORAMA_TERMS_INL_H
#else
#define NBVOPT_GAIN_PANORAMA_TERMS_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "gain/panorama_sum.hpp"
#include "gain/smooth_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Hits beside or behind the camera count as if this far in front; they are out of view anyway.
constexpr double kNearestDepth_m = 0.02;

/// Sums of a motion, a vector a component.
template <class D>
struct MotionLanes {
  hn::Vec<D> torque_x, torque_y, torque_z;
  hn::Vec<D> force_x, force_y, force_z;
  hn::Vec<D> area_x, area_y, area_z;  ///< of the surface's areas, in the map's axes

  HWY_INLINE explicit MotionLanes(D d)
      : torque_x(hn::Zero(d)),
        torque_y(hn::Zero(d)),
        torque_z(hn::Zero(d)),
        force_x(hn::Zero(d)),
        force_y(hn::Zero(d)),
        force_z(hn::Zero(d)),
        area_x(hn::Zero(d)),
        area_y(hn::Zero(d)),
        area_z(hn::Zero(d)) {}

  HWY_INLINE void write(D d, const PanoramaView& view, PanoramaSum& sum) const {
    const auto total = [&](hn::Vec<D> v)
                           HWY_ATTR { return double{hn::GetLane(hn::SumOfLanes(d, v))}; };
    sum.torque = {total(torque_x), total(torque_y), total(torque_z)};
    const Eigen::Vector3d area(total(area_x), total(area_y), total(area_z));
    sum.force =
        Eigen::Vector3d(total(force_x), total(force_y), total(force_z)) + view.R_sensor_map * area;
  }
};

/// The terms of as many hits as a vector has lanes.
template <class D>
struct Terms {
  using V = hn::Vec<D>;

  V x, y, z, inverse_z, tan_h, tan_v, distance, inverse_distance;
  V area_x, area_y, area_z;
  V rays;                         ///< the expected number of rays on the hit
  V rays_by_h, rays_by_v;         ///< derivatives by alpha_h, alpha_v
  V rays_by_distance, rays_by_z;  ///< by d, and by z where alphas and d stay
  V rays_by_area;                 ///< by area . way
  V gain;                         ///< of one of these rays, Equation (12)
  V gain_by_h, gain_by_v, gain_by_distance, gain_by_z;

  HWY_INLINE Terms(D d, const PanoramaModel& model, const PanoramaView& view, const HitBlock& block,
                   std::size_t i) {
    // The way from the optical centre, in the map's axes, then in the sensor's.
    const V way_x = hn::Sub(load(d, &block.x[i]), set(d, view.centre_m.x()));
    const V way_y = hn::Sub(load(d, &block.y[i]), set(d, view.centre_m.y()));
    const V way_z = hn::Sub(load(d, &block.z[i]), set(d, view.centre_m.z()));
    const auto along = [&](int row) HWY_ATTR {
      return hn::MulAdd(set(d, view.R_sensor_map(row, 0)), way_x,
                        hn::MulAdd(set(d, view.R_sensor_map(row, 1)), way_y,
                                   hn::Mul(set(d, view.R_sensor_map(row, 2)), way_z)));
    };
    const V one = set(d, 1.0);
    x = along(0);
    y = along(1);
    z = hn::Max(along(2), set(d, kNearestDepth_m));
    inverse_z = hn::Div(one, z);
    tan_h = hn::Mul(x, inverse_z);
    tan_v = hn::Mul(y, inverse_z);
    const V squared = hn::MulAdd(way_x, way_x, hn::MulAdd(way_y, way_y, hn::Mul(way_z, way_z)));
    distance = hn::Sqrt(squared);
    inverse_distance = hn::Div(one, hn::Max(distance, set(d, kNearestDepth_m)));
    const V alpha_h = hn::Atan(d, tan_h);  // Equation (3)
    const V alpha_v = hn::Atan(d, tan_v);  // Equation (4)

    area_x = load(d, &block.area_x[i]);
    area_y = load(d, &block.area_y[i]);
    area_z = load(d, &block.area_z[i]);
    const V facing = hn::MulAdd(area_x, way_x, hn::MulAdd(area_y, way_y, hn::Mul(area_z, way_z)));
    set_rays(d, model, view, alpha_h, alpha_v, hn::Max(facing, hn::Zero(d)));
    rays_by_area = hn::IfThenElseZero(hn::Gt(facing, hn::Zero(d)), rays_by_area);
    set_gain(d, model, alpha_h, alpha_v, load(d, &block.u_old[i]), load(d, &block.farthest_m[i]));
  }

  /// Adds the motion of rays * by_rays + gain * by_gain.
  HWY_INLINE void add_motion(D d, V by_rays, V by_gain, MotionLanes<D>& motion) const {
    const auto both = [&](V rays_part, V gain_part) HWY_ATTR {
      return hn::MulAdd(by_rays, rays_part, hn::Mul(by_gain, gain_part));
    };
    const V one = set(d, 1.0);
    // d alpha / d x = z / (x^2 + z^2), and -tan alpha times that by z.
    const V by_x =
        hn::Mul(both(rays_by_h, gain_by_h), hn::Div(inverse_z, hn::MulAdd(tan_h, tan_h, one)));
    const V by_y =
        hn::Mul(both(rays_by_v, gain_by_v), hn::Div(inverse_z, hn::MulAdd(tan_v, tan_v, one)));
    const V by_z =
        hn::NegMulAdd(tan_h, by_x, hn::NegMulAdd(tan_v, by_y, both(rays_by_z, gain_by_z)));
    const V radial = hn::Mul(both(rays_by_distance, gain_by_distance), inverse_distance);
    // What is along the ray has no torque.
    motion.torque_x = hn::Add(motion.torque_x, hn::MulSub(y, by_z, hn::Mul(z, by_y)));
    motion.torque_y = hn::Add(motion.torque_y, hn::MulSub(z, by_x, hn::Mul(x, by_z)));
    motion.torque_z = hn::Add(motion.torque_z, hn::MulSub(x, by_y, hn::Mul(y, by_x)));
    motion.force_x = hn::Add(motion.force_x, hn::MulAdd(radial, x, by_x));
    motion.force_y = hn::Add(motion.force_y, hn::MulAdd(radial, y, by_y));
    motion.force_z = hn::Add(motion.force_z, hn::MulAdd(radial, z, by_z));
    // A turn about the optical centre leaves area . way as it is.
    const V by_area = hn::Mul(by_rays, rays_by_area);
    motion.area_x = hn::MulAdd(by_area, area_x, motion.area_x);
    motion.area_y = hn::MulAdd(by_area, area_y, motion.area_y);
    motion.area_z = hn::MulAdd(by_area, area_z, motion.area_z);
  }

 private:
  /// w rho / J S S S_far: the area over z^3 is what the image sees of it, so that
  /// w / J = facing / z^3, J = (1 + X^2 + Y^2)^(-3/2) of pixel-centre rays.
  HWY_INLINE void set_rays(D d, const PanoramaModel& model, const PanoramaView& view, V alpha_h,
                           V alpha_v, V facing) {
    const V one = set(d, 1.0);
    V per_facing =
        hn::Mul(set(d, model.density), hn::Mul(inverse_z, hn::Mul(inverse_z, inverse_z)));
    if (model.equal_angles) {
      per_facing = hn::Div(per_facing,
                           hn::Mul(hn::MulAdd(tan_h, tan_h, one), hn::MulAdd(tan_v, tan_v, one)));
    }
    const Slope<D> in_h = edge(d, alpha_h, model.half_fov_h_rad, view.tau_h_rad);
    const Slope<D> in_v = edge(d, alpha_v, model.half_fov_v_rad, view.tau_v_rad);
    const V to_gate = hn::Sub(set(d, model.far_gate_m), model.z_depth ? z : distance);
    const Slope<D> near = step(d, hn::Mul(to_gate, set(d, 1.0 / model.far_gate_half_width_m)));

    const V open = hn::Mul(per_facing, near.value);
    rays_by_area = hn::Mul(open, hn::Mul(in_h.value, in_v.value));
    rays = hn::Mul(rays_by_area, facing);
    const V seen = hn::Mul(open, facing);
    rays_by_h = hn::Mul(seen, hn::Mul(in_h.slope, in_v.value));
    rays_by_v = hn::Mul(seen, hn::Mul(in_h.value, in_v.slope));
    if (model.equal_angles) {
      // 1 / (1 + X^2) = cos^2 alpha, whose relative slope is -2 X.
      rays_by_h = hn::NegMulAdd(hn::Add(tan_h, tan_h), rays, rays_by_h);
      rays_by_v = hn::NegMulAdd(hn::Add(tan_v, tan_v), rays, rays_by_v);
    }
    const V by_gate = hn::Mul(hn::Mul(hn::Mul(per_facing, facing), hn::Mul(in_h.value, in_v.value)),
                              hn::Mul(near.slope, set(d, -1.0 / model.far_gate_half_width_m)));
    rays_by_distance = model.z_depth ? hn::Zero(d) : by_gate;
    rays_by_z =
        hn::NegMulAdd(hn::Mul(set(d, 3.0), inverse_z), rays, model.z_depth ? by_gate : hn::Zero(d));
  }

  HWY_INLINE void set_gain(D d, const PanoramaModel& model, V alpha_h, V alpha_v, V u_old,
                           V farthest) {
    const V one = set(d, 1.0);
    // Nothing is seen nearer than range_min, which runs along z where depths do.
    const V nearest = set(d, model.range_min_m);
    const V measured = model.z_depth ? z : distance;
    const V kept = hn::Min(hn::Max(measured, nearest), farthest);
    const auto is_free = hn::Eq(kept, measured);
    const V per_depth = hn::Mul(distance, inverse_z);
    const V seen_at = model.z_depth ? hn::Mul(kept, per_depth) : kept;

    const Slope<D> d_focal =
        rounded_abs(d, hn::Sub(seen_at, set(d, model.focal_distance_m)));  // (1)
    const V u_distance = hn::Sub(
        one, hn::Div(set(d, 2.0), hn::Add(one, hn::Exp(d, d_focal.value))));  // Equation (2)
    const Slope<D> size_h = rounded_abs(d, alpha_h);
    const Slope<D> size_v = rounded_abs(d, alpha_v);
    const V weight_h = set(d, model.weight_h_per_rad);
    const V weight_v = set(d, model.weight_v_per_rad);
    const V u_new = hn::MulAdd(
        set(d, model.weight_distance), u_distance,
        hn::MulAdd(weight_h, size_h.value, hn::Mul(weight_v, size_v.value)));  // Equation (8)
    const Slope<D> more = rounded_relu(d, hn::Sub(u_old, u_new));              // Equation (12)
    gain = more.value;
    const V less = hn::Neg(more.slope);
    gain_by_h = hn::Mul(less, hn::Mul(weight_h, size_h.slope));
    gain_by_v = hn::Mul(less, hn::Mul(weight_v, size_v.slope));
    // d u_d / d d_focal = (1 - u_d^2) / 2.
    const V by_seen_at =
        hn::Mul(hn::Mul(less, set(d, 0.5 * model.weight_distance)),
                hn::Mul(d_focal.slope, hn::NegMulAdd(u_distance, u_distance, one)));
    gain_by_distance = hn::IfThenElseZero(is_free, by_seen_at);
    gain_by_z = hn::Zero(d);
    if (model.z_depth) {
      // Held at a depth, the distance is kept / z times d.
      const V held = hn::IfThenZeroElse(is_free, hn::Mul(by_seen_at, hn::Mul(kept, inverse_z)));
      gain_by_distance = hn::Add(gain_by_distance, held);
      gain_by_z = hn::Neg(hn::Mul(held, per_depth));
    }
  }
};

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // per-target include guard
