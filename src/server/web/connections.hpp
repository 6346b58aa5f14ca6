// Connections that have a thread each.
#pragma once

#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "core/descriptor.hpp"

namespace nbvopt {

/// The sockets, which can be ended from outside. Safe to share between threads.
class OpenConnections {
 public:
  void add(int socket) {
    const std::scoped_lock lock(mutex_);
    sockets_.insert(socket);
    if (is_ending_) ::shutdown(socket, SHUT_RDWR);
  }
  /// Closes it.
  void remove(Descriptor socket) {
    const std::scoped_lock lock(mutex_);
    sockets_.erase(socket.get());
    socket.close();
  }
  void end_all() {
    {
      const std::scoped_lock lock(mutex_);
      is_ending_ = true;
      for (const int socket : sockets_) ::shutdown(socket, SHUT_RDWR);
    }
    ended_.notify_all();
  }
  /// Waits so long. False: all connections end.
  bool wait(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return !ended_.wait_for(lock, time, [this] { return is_ending_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  std::set<int> sockets_;
  bool is_ending_ = false;
};

/// A thread a connection, for as long as it lasts: one that waits for the next would hold what all
/// libraries keep for each thread, a megabyte and a half.
class ConnectionThreads {
 public:
  ~ConnectionThreads() {
    for (Running& each : running_) each.thread.join();
  }

  /// Called by one thread at a time. Throws std::system_error where the system gives no thread.
  template <typename Work>
  void start(Work work) {
    std::erase_if(running_, [](Running& each) {
      if (!*each.has_ended) return false;
      each.thread.join();
      return true;
    });
    auto has_ended = std::make_shared<std::atomic<bool>>(false);
    running_.push_back({std::thread([work = std::move(work), has_ended] {
                          work();
                          *has_ended = true;
                        }),
                        has_ended});
  }

 private:
  struct Running {
    std::thread thread;
    std::shared_ptr<std::atomic<bool>> has_ended;
  };
  std::list<Running> running_;
};

}  // namespace nbvopt
