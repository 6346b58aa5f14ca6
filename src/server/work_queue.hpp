// Threads that do work, and a bounded queue a client before them, in turns.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

namespace nbvopt {

class WorkQueue {
 public:
  /// At most `max_waiting` pieces of work of one client wait while all threads are busy.
  WorkQueue(std::size_t threads, std::size_t max_waiting);
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  /// Does what still waits, then ends the threads.
  ~WorkQueue();

  /// False, and the work is not taken, when too much of that client's waits already. A client's
  /// work is begun in the order in which it came; clients take turns, so that one with much work
  /// delays the others by one piece of it each. `work` must not throw.
  bool try_post(std::function<void()> work, const std::string& client = {});

 private:
  void run();
  /// The next client's next piece of work, which then waits no more.
  std::function<void()> take();

  const std::size_t thread_count_;
  const std::size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::unordered_map<std::string, std::deque<std::function<void()>>> waiting_;  ///< none is empty
  std::deque<std::string> turns_;  ///< the clients of `waiting_`, who is next first
  std::size_t busy_ = 0;           ///< threads at work
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace nbvopt
