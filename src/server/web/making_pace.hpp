// How often what pages ask for is made.
#pragma once

#include <algorithm>
#include <chrono>

namespace nbvopt {

/// A fifth of a core in the long run: time that was not used is saved, up to kMostSaved, so that a
/// first page is not followed by a pause as long as a large map takes.
class MakingPace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kShare = 5;
  static constexpr std::chrono::seconds kMostSaved{10};

  explicit MakingPace(Clock::duration least_pause) : least_pause_(least_pause) {}

  bool allows(Clock::time_point now) const {
    return !has_made_ || (now - last_end_ >= least_pause_ && saved(now) > Clock::duration::zero());
  }

  void took(Clock::time_point start, Clock::time_point end) {
    saved_ = saved(end) - (end - start);
    last_end_ = end;
    has_made_ = true;
  }

 private:
  Clock::duration saved(Clock::time_point now) const {
    if (!has_made_) return kMostSaved;
    return std::min<Clock::duration>(kMostSaved, saved_ + (now - last_end_) / kShare);
  }

  const Clock::duration least_pause_;
  bool has_made_ = false;
  Clock::time_point last_end_{};  ///< where it has
  Clock::duration saved_{0};      ///< at last_end_
};

}  // namespace nbvopt
