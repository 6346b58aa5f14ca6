// Ends calls whose message does not come to its end.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace nbvopt {

/// A call whose message is on its way.
class ReceivingCall {
 public:
  /// The message has taken too long; from a thread of the watch.
  virtual void end_late() = 0;

 protected:
  ~ReceivingCall() = default;
};

/// Safe to share between threads.
class ReceiveWatch {
 public:
  /// `most`: how long a message may take.
  explicit ReceiveWatch(std::chrono::milliseconds most);
  ReceiveWatch(const ReceiveWatch&) = delete;
  ReceiveWatch& operator=(const ReceiveWatch&) = delete;
  ~ReceiveWatch();

  /// From now on the call's message is awaited. The call must live until it is removed, or has been
  /// told that it is late.
  void add(ReceivingCall& call);

  /// The message has come, or will not. False: the call is late, and end_late() ends it.
  bool remove(ReceivingCall& call);

 private:
  using Clock = std::chrono::steady_clock;

  void run();
  /// Takes out who is late.
  std::vector<ReceivingCall*> take_late();

  const std::chrono::milliseconds most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::unordered_map<ReceivingCall*, Clock::time_point> awaited_;  ///< and until when
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace nbvopt
