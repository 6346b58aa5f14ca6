#include "gain/bound_row.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gain/bound_row.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace nbvopt::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void bound_row(const RayWindows& rays, const float* windows, int begin, int end, float* sums) {
  const hn::CappedTag<float, 16> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  // Two vectors at once: a sum waits for the one before.
  for (int k = begin; k < end; k += 2 * lanes) {
    const float* first_bin = windows + k;
    auto sum = zero;
    auto next_sum = zero;
    std::int32_t at = 0;
    for (std::size_t i = 0; i < rays.end.size(); ++i) {
      const float* window = first_bin + rays.offset[static_cast<std::size_t>(at)];
      auto most = hn::LoadU(d, window);
      auto next_most = hn::LoadU(d, window + lanes);
      for (++at; at < rays.end[i]; ++at) {
        window = first_bin + rays.offset[static_cast<std::size_t>(at)];
        most = hn::Max(most, hn::LoadU(d, window));
        next_most = hn::Max(next_most, hn::LoadU(d, window + lanes));
      }
      const auto angle_part = hn::Set(d, rays.angle_part[i]);
      sum = hn::Add(sum, hn::Max(zero, hn::Sub(most, angle_part)));
      next_sum = hn::Add(next_sum, hn::Max(zero, hn::Sub(next_most, angle_part)));
    }
    alignas(64) float both[2 * 16];
    hn::Store(sum, d, both);
    hn::StoreU(next_sum, d, both + lanes);
    std::copy_n(both, std::min(2 * lanes, end - k), sums + (k - begin));
  }
}

}  // namespace nbvopt::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nbvopt::detail {

HWY_EXPORT(bound_row);

void bound_row(const RayWindows& rays, const float* windows, int begin, int end, float* sums) {
  HWY_DYNAMIC_DISPATCH(bound_row)(rays, windows, begin, end, sums);
}

}  // namespace nbvopt::detail
#endif
