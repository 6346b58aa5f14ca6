// What views gain around a server's newest plan, for pages that ask.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "nbvopt/core/stop.hpp"
#include "server/web/live_sources.hpp"
#include "server/web/making_pace.hpp"

namespace nbvopt {

/// Safe to share between threads.
class LiveGains {
 public:
  /// A landscape that takes longer than `most_ms` is left out.
  LiveGains(LiveSources sources, std::chrono::milliseconds least_pause, double most_ms = 10000.0);

  /// JSON on one line: `plan`, the number of the plan that it is for; where that is not 0 `answer`,
  /// `map_version`, on which its gains were judged again, and what view_gains() tells, the `blocks`
  /// by their names; `error`, where that cannot be told. Made on one thread when somebody asks,
  /// once for all who do, at the pace of MakingPace: an older one is given meanwhile.
  std::shared_ptr<const std::string> newest();

  /// Lets nobody wait for a landscape any more.
  void end() const { end_.cancel(); }

 private:
  std::string made(const PlanLog::Newest& newest) const;

  const LiveSources sources_;
  const double most_ms_;
  const CancelToken end_;

  std::mutex making_;  ///< of what follows; held while it is made
  std::shared_ptr<const std::string> text_;
  std::uint64_t plan_ = 0;
  MakingPace pace_;
};

}  // namespace nbvopt
