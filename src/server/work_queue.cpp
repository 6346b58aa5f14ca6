#include "server/work_queue.hpp"

#include <utility>

namespace nbvopt {

WorkQueue::WorkQueue(std::size_t threads, std::size_t max_waiting)
    : thread_count_(threads), max_waiting_(max_waiting) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
}

WorkQueue::~WorkQueue() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

bool WorkQueue::try_post(std::function<void()> work, const std::string& client) {
  {
    const std::scoped_lock lock(mutex_);
    const auto known = waiting_.find(client);
    const std::size_t before = known == waiting_.end() ? 0 : known->second.size();
    if (before + busy_ >= max_waiting_ + thread_count_) return false;
    if (before == 0) turns_.push_back(client);
    waiting_[client].push_back(std::move(work));
  }
  changed_.notify_one();
  return true;
}

void WorkQueue::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    ++busy_;
    const std::function<void()> work = take();
    lock.unlock();
    work();
    lock.lock();
    --busy_;
  }
}

std::function<void()> WorkQueue::take() {
  const auto client = waiting_.find(turns_.front());
  turns_.pop_front();
  std::function<void()> work = std::move(client->second.front());
  client->second.pop_front();
  if (client->second.empty()) {
    waiting_.erase(client);
  } else {
    turns_.push_back(client->first);
  }
  return work;
}

}  // namespace nbvopt
