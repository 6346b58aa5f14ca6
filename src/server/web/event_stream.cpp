#include "server/web/event_stream.hpp"

namespace nbvopt {

bool EventStream::turn(bool has_taken_all, const std::function<bool(const std::string&)>& send) {
  const Clock::time_point now = Clock::now();
  if (!has_taken_all) {
    ++log_.waits;
    return now - last_taken_ < most_stall_;
  }
  last_taken_ = now;
  const LiveVersion newest = page_.newest();
  if (told_ == newest) {
    if (now - last_sent_ < kHeartbeat) return true;
    last_sent_ = now;
    return send(":\n\n");
  }
  last_sent_ = now;
  const bool is_first = !told_;
  told_ = newest;
  ++log_.events;
  return send((is_first ? "retry: 1000\n" : "") + ("event: state\ndata: " + page_.state()) +
              "\n\n");
}

}  // namespace nbvopt
