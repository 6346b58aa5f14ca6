#include "server/latency_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace nbvopt {

const std::array<double, LatencyHistogram::kBounds>& LatencyHistogram::upper_bounds_ms() {
  static const std::array<double, kBounds> bounds_ms = [] {
    std::array<double, kBounds> bounds{};
    for (std::size_t i = 0; i < kBounds; ++i) {
      bounds[i] = 0.05 * std::exp2(0.25 * static_cast<double>(i));
    }
    return bounds;
  }();
  return bounds_ms;
}

void LatencyHistogram::record(double elapsed_ms) {
  const auto& bounds_ms = upper_bounds_ms();
  const auto bucket = std::lower_bound(bounds_ms.begin(), bounds_ms.end(), elapsed_ms);
  const std::scoped_lock lock(mutex_);
  ++counts_.buckets[static_cast<std::size_t>(bucket - bounds_ms.begin())];
  ++counts_.calls;
  counts_.sum_ms += elapsed_ms;
  counts_.max_ms = std::max(counts_.max_ms, elapsed_ms);
}

LatencyHistogram::Counts LatencyHistogram::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

}  // namespace nbvopt
