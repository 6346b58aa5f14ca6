// Takes in connections, so many and no more, whatever clients do.
//
// gRPC's own listener closes itself for good when the process runs out of descriptors once, holds
// connections without bound, and keeps those that say nothing for two minutes.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/descriptor.hpp"
#include "server/connection_log.hpp"

namespace nbvopt {

/// How many sockets the server may hold, so that files can still be opened.
struct SocketBudget {
  std::size_t connections = 0;  ///< that have said something
  std::size_t silent = 0;       ///< that have not yet
};

/// What the limit of descriptors allows, at most `max_connections`: some are kept for snapshots and
/// the clients' maps, and `promised` ones that others will open. Throws UsageError that names the
/// limit where it is too low for any.
SocketBudget socket_budget(std::size_t max_connections, std::size_t promised = 0);

/// A thread that accepts connections from its construction until stop().
///
/// A connection is handed over when its first byte has come: in all protocols here the client
/// speaks first. Until then it is one of the silent ones, of which the oldest goes when there are
/// too many or when its time is over: they keep nobody out.
class Acceptor {
 public:
  struct Hooks {
    /// Takes a connection that has spoken; who takes it closes it, by this number.
    std::function<void(int connection, int listening)> hand_over;
    /// Told whenever it changes whether another client would find a place; at first it would.
    std::function<void(bool has_room)> on_room;
  };
  /// How long a connection may say nothing.
  static constexpr std::chrono::seconds kMostSilence{10};

  /// `log` must outlive it.
  Acceptor(std::vector<Descriptor> listening, SocketBudget budget, ConnectionLog& log, Hooks hooks);
  Acceptor(const Acceptor&) = delete;
  Acceptor& operator=(const Acceptor&) = delete;
  ~Acceptor() { stop(); }

  /// Whether its thread has looked at its sockets within that time.
  bool has_turned_within(std::chrono::milliseconds time) const;

  /// Accepts no more, and closes what was silent.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  /// One that has said nothing yet.
  struct Silent {
    Descriptor socket;
    int listening;
    Clock::time_point since;
  };
  /// One that is somebody else's by now: the number of a closed one may mean another file already.
  struct HandedOver {
    int descriptor;
    ino_t inode;
  };

  void run();
  /// Waits for something to happen on a socket, or a little.
  void wait();
  void hand_over_who_spoke();
  void hand_over(Silent& connection);
  void drop_the_oldest_silent();
  void forget_closed();
  void accept_all();
  /// False: there is nobody more, for now.
  bool accept_from(const Descriptor& listening);
  void tell_room();

  std::vector<Descriptor> listening_;
  const SocketBudget budget_;
  ConnectionLog& log_;
  const Hooks hooks_;
  Descriptor wake_;
  std::deque<Silent> silent_;  ///< the oldest first
  std::vector<HandedOver> handed_over_;
  bool is_starved_ = false;  ///< of descriptors or memory
  bool has_room_ = true;
  std::atomic<Clock::time_point> last_turn_{Clock::now()};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace nbvopt
