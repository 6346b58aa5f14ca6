// What one reader of the page is told: always the newest, however slowly it reads.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "server/web/live_page.hpp"
#include "server/web/web_log.hpp"

namespace nbvopt {

/// Server-Sent Events: `state`, whose data is LivePage::state(). Nothing is queued: what changes
/// between two turns is told once, and nothing while the reader has not taken what it was sent.
class EventStream {
 public:
  static constexpr std::chrono::milliseconds kTurn{100};
  /// How often a reader without news is sent a comment, or nobody would notice that it is gone.
  static constexpr std::chrono::seconds kHeartbeat{5};

  /// Who takes nothing for `most_stall` is let go. Page and log must outlive it.
  EventStream(LivePage& page, WebLog& log, std::chrono::milliseconds most_stall)
      : page_(page), reader_(page), log_(log), most_stall_(most_stall) {}

  /// To be called every kTurn. `send` says whether it could be sent. False: the stream has ended.
  bool turn(bool has_taken_all, const std::function<bool(const std::string&)>& send);

 private:
  using Clock = std::chrono::steady_clock;

  const LivePage& page_;
  const LivePage::Reader reader_;
  WebLog& log_;
  const std::chrono::milliseconds most_stall_;
  std::optional<LiveVersion> told_;
  Clock::time_point last_taken_ = Clock::now();
  Clock::time_point last_sent_ = Clock::now();
};

}  // namespace nbvopt
