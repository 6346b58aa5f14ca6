// Who is connected, and who was not let in.
#pragma once

#include <atomic>
#include <cstdint>

#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

/// Safe to share between threads.
struct ConnectionLog {
  std::atomic<std::uint64_t> open{0};     ///< that have said something
  std::atomic<std::uint64_t> refused{0};  ///< since there was no place left
  std::atomic<std::uint64_t> silent{0};   ///< closed, since they said nothing

  void write(v1::GetStatusReply& reply) const {
    reply.set_connections(open);
    reply.set_connections_refused(refused);
    reply.set_connections_silent(silent);
  }
};

}  // namespace nbvopt
