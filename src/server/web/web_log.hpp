// What the page's server has done.
#pragma once

#include <atomic>
#include <cstdint>

#include "server/connection_log.hpp"

namespace nbvopt {

/// Safe to share between threads.
struct WebLog {
  ConnectionLog connections;
  std::atomic<std::uint64_t> answers{0};    ///< of requests that were let in
  std::atomic<std::uint64_t> forbidden{0};  ///< requests that were not, see web_refusal()
  std::atomic<std::uint64_t> events{0};     ///< that readers of the page were sent
  std::atomic<std::uint64_t> waits{0};      ///< turns in which a reader had not taken the last one
};

}  // namespace nbvopt
