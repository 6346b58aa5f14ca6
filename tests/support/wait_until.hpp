// Waiting for what another thread or process brings about.
#pragma once

#include <chrono>
#include <thread>

namespace nbvopt::test {

/// Asks until the answer is true; false when it was not within a minute.
template <typename Ask>
bool wait_until(const Ask& ask) {
  for (int i = 0; i < 60'000; ++i) {
    if (ask()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace nbvopt::test
