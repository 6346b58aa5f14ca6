// What systemd wants to hear of a service (sd_notify(3)).
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace nbvopt {

/// Who started the process and waits to hear how it is; often nobody.
class ServiceManager {
 public:
  /// `socket`: a path, or '@' and the name of an abstract socket; empty: there is no manager.
  /// `watchdog`: it takes the process for dead when it has heard nothing for so long.
  explicit ServiceManager(std::string socket,
                          std::optional<std::chrono::microseconds> watchdog = std::nullopt);

  /// As NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID say.
  static ServiceManager from_environment();

  /// Tells a state such as "READY=1". A manager that does not listen is none of our business.
  void notify(const std::string& state) const;

  const std::optional<std::chrono::microseconds>& watchdog() const { return watchdog_; }

 private:
  std::string socket_;
  std::optional<std::chrono::microseconds> watchdog_;
};

/// Tells the manager twice within its patience that the process is alive, for as long as this lives
/// and `is_alive(timeout)` says so, which must answer within the timeout.
class Heartbeat {
 public:
  /// The manager must outlive it.
  Heartbeat(const ServiceManager& manager, std::function<bool(std::chrono::milliseconds)> is_alive);
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;
  ~Heartbeat();

 private:
  void run(std::chrono::microseconds every);

  const ServiceManager& manager_;
  const std::function<bool(std::chrono::milliseconds)> is_alive_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace nbvopt
