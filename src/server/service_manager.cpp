#include "server/service_manager.hpp"

#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "core/descriptor.hpp"
#include "map/whole_number.hpp"

namespace nbvopt {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

ServiceManager::ServiceManager(std::string socket,
                               std::optional<std::chrono::microseconds> watchdog)
    : socket_(std::move(socket)), watchdog_(watchdog) {}

ServiceManager ServiceManager::from_environment() {
  const std::string socket = environment("NOTIFY_SOCKET");
  const std::string process = environment("WATCHDOG_PID");
  const std::uint64_t patience_us = parse_whole_number(environment("WATCHDOG_USEC")).value_or(0);
  const bool is_for_us = process.empty() || process == std::to_string(::getpid());
  constexpr std::uint64_t kForEver_us = 1'000'000'000'000'000;
  if (!is_for_us || patience_us == 0 || patience_us > kForEver_us) return ServiceManager(socket);
  return ServiceManager(socket, std::chrono::microseconds(patience_us));
}

void ServiceManager::notify(const std::string& state) const {
  sockaddr_un where{};
  if (socket_.empty() || socket_.size() >= sizeof(where.sun_path)) return;
  where.sun_family = AF_UNIX;
  socket_.copy(where.sun_path, socket_.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  if (where.sun_path[0] == '@') where.sun_path[0] = '\0';
  const Descriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ::sendto(socket.get(), state.data(), state.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
           reinterpret_cast<const sockaddr*>(&where), length);
}

Heartbeat::Heartbeat(const ServiceManager& manager,
                     std::function<bool(std::chrono::milliseconds)> is_alive)
    : manager_(manager), is_alive_(std::move(is_alive)) {
  if (!manager_.watchdog()) return;
  constexpr std::chrono::microseconds kLeast{2'000};
  const auto every = std::max(*manager_.watchdog() / 2, kLeast);
  thread_ = std::thread([this, every] { run(every); });
}

Heartbeat::~Heartbeat() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Heartbeat::run(std::chrono::microseconds every) {
  const auto timeout = std::chrono::duration_cast<std::chrono::milliseconds>(every / 2);
  std::unique_lock lock(mutex_);
  do {
    lock.unlock();
    if (is_alive_(timeout)) {
      manager_.notify("WATCHDOG=1");
    } else {
      spdlog::error("event=does_not_answer_itself");
    }
    lock.lock();
  } while (!changed_.wait_for(lock, every, [this] { return closing_; }));
}

}  // namespace nbvopt
