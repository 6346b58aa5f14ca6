// When a search ends before it is done: evaluations, time, cancellation.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace nbvopt {

/// A flag that one thread raises and others read. Copies share the flag: whoever asked for the
/// search keeps one copy to cancel with, the search reads the other.
class CancelToken {
 public:
  CancelToken() : cancelled_(std::make_shared<std::atomic<bool>>(false)) {}
  void cancel() const { cancelled_->store(true, std::memory_order_relaxed); }
  bool is_cancelled() const { return cancelled_->load(std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> cancelled_;
};

/// What bounds a search. The default never stops it.
struct StopRule {
  using Clock = std::chrono::steady_clock;

  std::int64_t max_evaluations = std::numeric_limits<std::int64_t>::max();
  std::optional<Clock::time_point> deadline;  ///< none: no time limit
  CancelToken cancel;

  /// Stops so many milliseconds from a time on; now unless another is given.
  static StopRule within(double limit_ms, Clock::time_point since = Clock::now()) {
    StopRule stop;
    stop.deadline = since + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double, std::milli>(limit_ms));
    return stop;
  }

  bool is_expired() const { return deadline && Clock::now() >= *deadline; }
};

}  // namespace nbvopt
