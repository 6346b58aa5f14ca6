// Waiting until a search that somebody else runs is at work, as the processors' time tells that it
// takes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <ctime>
#include <stdexcept>

#include "support/wait_until.hpp"

namespace nbvopt::test {

inline double clock_s(clockid_t clock) {
  timespec time{};
  if (::clock_gettime(clock, &time) != 0) throw std::runtime_error("no clock of this process");
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// False when, for a minute, what the function tells never grew as a search makes it grow, even on
/// a machine that has much else to do. A server without work takes some milliseconds a second.
template <typename CpuTime>
bool wait_for_growth(const CpuTime& cpu_time_s) {
  using Clock = std::chrono::steady_clock;
  constexpr double kOfASearch_s = 0.1;
  constexpr std::chrono::seconds kWithin(2);
  double begin_s = cpu_time_s();
  Clock::time_point begin = Clock::now();
  return wait_until([&] {
    if (Clock::now() > begin + kWithin) {
      begin = Clock::now();
      begin_s = cpu_time_s();
    }
    return cpu_time_s() > begin_s + kOfASearch_s;
  });
}

/// In another process.
inline bool wait_for_search(pid_t process) {
  clockid_t clock{};
  if (::clock_getcpuclockid(process, &clock) != 0) throw std::runtime_error("no such process");
  return wait_for_growth([clock] { return clock_s(clock); });
}

/// In another thread of this process.
inline bool wait_for_search() {
  return wait_for_growth(
      [] { return clock_s(CLOCK_PROCESS_CPUTIME_ID) - clock_s(CLOCK_THREAD_CPUTIME_ID); });
}

}  // namespace nbvopt::test
