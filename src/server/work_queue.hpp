// Threads that do work in the order in which it came, and a bounded queue before them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace nbvopt {

class WorkQueue {
 public:
  /// At most `max_waiting` pieces of work wait while all threads are busy.
  WorkQueue(std::size_t threads, std::size_t max_waiting);
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  /// Does what still waits, then ends the threads.
  ~WorkQueue();

  /// False, and the work is not taken, when too much waits already. `work` must not throw.
  bool try_post(std::function<void()> work);

 private:
  void run();

  const std::size_t thread_count_;
  const std::size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::size_t busy_ = 0;  ///< threads at work
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace nbvopt
