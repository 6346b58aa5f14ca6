// How long calls take.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace nbvopt {

/// Buckets whose bounds grow by a factor of 2^(1/4), from 0.05 ms to 26 s: quantiles are known to a
/// fifth. Safe to share between threads.
class LatencyHistogram {
 public:
  static constexpr std::size_t kBounds = 77;

  struct Counts {
    std::uint64_t calls = 0;
    double sum_ms = 0.0;
    double max_ms = 0.0;
    std::array<std::uint64_t, kBounds + 1> buckets{};  ///< the last one has no bound
  };

  /// The upper bounds of all buckets but the last.
  static const std::array<double, kBounds>& upper_bounds_ms();

  void record(double elapsed_ms);
  Counts counts() const;

 private:
  mutable std::mutex mutex_;
  Counts counts_;
};

}  // namespace nbvopt
