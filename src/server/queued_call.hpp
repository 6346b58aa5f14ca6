// What all calls share: their limits, and their entry in the log.
#pragma once

#include <grpc/support/time.h>
#include <grpcpp/grpcpp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <string>

#include "nbvopt/core/stop.hpp"
#include "server/call_log.hpp"
#include "server/call_status.hpp"
#include "server/work_queue.hpp"

namespace nbvopt {

/// One call's limits: the client's deadline and its cancellation.
class CallLimits {
 public:
  explicit CallLimits(const grpc::CallbackServerContext& context) {
    const gpr_timespec left =
        gpr_time_sub(context.raw_deadline(), gpr_now(context.raw_deadline().clock_type));
    constexpr std::int64_t kDay_s = 86'400;
    if (left.tv_sec > kDay_s) return;  // none, or as good as none
    // From here on by the steady clock, which nobody sets. A tenth is left for the reply's way and
    // for the evaluation that is under way when time is over.
    const StopRule::Clock::duration time = std::chrono::seconds(std::max(left.tv_sec, -kDay_s)) +
                                           std::chrono::nanoseconds(left.tv_nsec);
    constexpr StopRule::Clock::duration kLeast = std::chrono::milliseconds(1);
    constexpr StopRule::Clock::duration kMost = std::chrono::milliseconds(50);
    stop_.deadline = received_ + time - std::clamp(time / 10, kLeast, kMost);
  }

  /// The call's message is here, all of it.
  void restart() { received_ = StopRule::Clock::now(); }

  StopRule::Clock::time_point received() const { return received_; }
  const StopRule& stop() const { return stop_; }
  void cancel() const { stop_.cancel.cancel(); }

 private:
  StopRule::Clock::time_point received_ = StopRule::Clock::now();
  StopRule stop_;
};

/// Who shares a turn on a queue: the calls of a connection, and apart from them its streams, which
/// ask for more whenever they are answered. gRPC tells connections over a Unix socket not apart.
inline std::string calls_of(const grpc::CallbackServerContext& context) { return context.peer(); }
inline std::string streams_of(const grpc::CallbackServerContext& context) {
  return context.peer() + " streams";
}

/// Does a piece of work that was received then, and logs how it went.
template <typename Run>
grpc::Status logged(CallLog& log, Method method, StopRule::Clock::time_point received,
                    const Run& run) {
  try {
    run();
    const std::chrono::duration<double, std::milli> elapsed = StopRule::Clock::now() - received;
    log.record_answer(method, elapsed.count());
    return grpc::Status::OK;
  } catch (const std::exception& error) {
    grpc::Status status = status_of(error);
    log.record_failure(method, status.error_code());
    if (status.error_code() == grpc::StatusCode::INTERNAL) {
      spdlog::error("event=internal_error error=\"{}\"", error.what());
    }
    return status;
  }
}

}  // namespace nbvopt
