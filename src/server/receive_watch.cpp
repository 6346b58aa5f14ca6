#include "server/receive_watch.hpp"

#include <algorithm>

namespace nbvopt {

ReceiveWatch::ReceiveWatch(std::chrono::milliseconds most) : most_(most) {
  thread_ = std::thread([this] { run(); });
}

ReceiveWatch::~ReceiveWatch() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ReceiveWatch::add(ReceivingCall& call) {
  const std::scoped_lock lock(mutex_);
  awaited_.emplace(&call, Clock::now() + most_);
}

bool ReceiveWatch::remove(ReceivingCall& call) {
  const std::scoped_lock lock(mutex_);
  return awaited_.erase(&call) == 1;
}

void ReceiveWatch::run() {
  // Nearly all messages come at once: looking now and then costs less than a timer a call.
  constexpr std::chrono::milliseconds kLongest{250};
  const auto turn = std::clamp(most_ / 4, std::chrono::milliseconds(1), kLongest);
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, turn, [this] { return closing_; })) {
    const std::vector<ReceivingCall*> late = take_late();
    lock.unlock();  // gRPC may call back from within what it is told
    for (ReceivingCall* each : late) each->end_late();
    lock.lock();
  }
}

std::vector<ReceivingCall*> ReceiveWatch::take_late() {
  std::vector<ReceivingCall*> late;
  const Clock::time_point now = Clock::now();
  std::erase_if(awaited_, [&](const auto& each) {
    if (now < each.second) return false;
    late.push_back(each.first);
    return true;
  });
  return late;
}

}  // namespace nbvopt
