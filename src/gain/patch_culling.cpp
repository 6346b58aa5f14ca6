#include "gain/patch_culling.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gain/patch_culling.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rounding of single precision, radians.
constexpr float kSlack = 1e-4F;

/// One side of the pyramid of view: its normal, in the map's axes, points out of it.
struct Side {
  float x, y, z;
  float centre;  ///< the optical centre along the normal
};

Side side(const PanoramaView& view, int axis, double sign, double half_fov_rad) {
  const Eigen::Vector3d normal =
      sign * std::cos(half_fov_rad) * view.R_sensor_map.row(axis).transpose() -
      std::sin(half_fov_rad) * view.R_sensor_map.row(2).transpose();
  return {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
          static_cast<float>(normal.z()), static_cast<float>(normal.dot(view.centre_m))};
}

void in_view(const PanoramaDirections& directions, const std::vector<float>& radius,
             const std::vector<float>& nearness, const PanoramaView& view, double half_fov_h_rad,
             double half_fov_v_rad, std::vector<std::uint32_t>& ids) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t n = directions.patch_count();
  // A patch's neighbours are beside it: they are mostly out by the same side.
  const std::array<Side, 4> sides{
      side(view, 0, 1.0, half_fov_h_rad), side(view, 0, -1.0, half_fov_h_rad),
      side(view, 1, 1.0, half_fov_v_rad), side(view, 1, -1.0, half_fov_v_rad)};
  ids.resize(n + lanes);
  std::size_t found = 0;
  for (std::size_t i = 0; i < n; i += lanes) {
    const auto part = [&](const std::vector<float>& values) HWY_ATTR {
      return i + lanes <= n ? hn::LoadU(d, &values[i])
                            : hn::MaskedLoad(hn::FirstN(d, n - i), d, &values[i]);
    };
    const auto spread = hn::Add(part(radius), hn::Set(d, kSlack));
    const auto near = part(nearness);
    auto inside = hn::FirstN(d, std::min(lanes, n - i));
    for (const Side& s : sides) {
      const auto dot = [&](const std::vector<float>& x, const std::vector<float>& y,
                           const std::vector<float>& z) HWY_ATTR {
        return hn::MulAdd(hn::Set(d, s.x), part(x),
                          hn::MulAdd(hn::Set(d, s.y), part(y), hn::Mul(hn::Set(d, s.z), part(z))));
      };
      const auto out = dot(directions.axis_x, directions.axis_y, directions.axis_z);
      // Seen from the optical centre instead of the place of casting, a hit moves in by the way
      // between them over its distance.
      const auto way = hn::Sub(hn::Set(d, s.centre),
                               dot(directions.lever_x, directions.lever_y, directions.lever_z));
      const auto moved_in = hn::Max(hn::Zero(d), hn::Mul(way, near));
      inside = hn::And(inside, hn::Lt(hn::Sub(out, moved_in), spread));
      if (hn::AllFalse(d, inside)) break;
    }
    if (hn::AllFalse(d, inside)) continue;
    const auto numbers = hn::Iota(du, static_cast<std::uint32_t>(i));
    // Storing a compressed vector whole is much faster than compressing into memory.
    hn::StoreU(hn::Compress(numbers, hn::RebindMask(du, inside)), du, ids.data() + found);
    found += hn::CountTrue(d, inside);
  }
  ids.resize(found);
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(in_view);

void patches_in_view(const PanoramaDirections& directions, const std::vector<float>& radius,
                     const std::vector<float>& nearness, const PanoramaView& view,
                     double half_fov_h_rad, double half_fov_v_rad,
                     std::vector<std::uint32_t>& ids) {
  HWY_DYNAMIC_DISPATCH(in_view)
  (directions, radius, nearness, view, half_fov_h_rad, half_fov_v_rad, ids);
}

}  // namespace nbvopt::detail
#endif
