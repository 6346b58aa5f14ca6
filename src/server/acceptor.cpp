#include "server/acceptor.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// For snapshots, clients' maps and what libraries open.
constexpr std::size_t kKeptDescriptors = 32;
constexpr std::size_t kMostSilent = 64;
/// How late the end of a connection is noticed.
constexpr std::chrono::milliseconds kTurn{250};

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

std::optional<ino_t> inode_of(int descriptor) {
  struct stat file {};
  if (::fstat(descriptor, &file) != 0) return {};
  return file.st_ino;
}

/// Small messages go at once; a Unix socket knows no delay and refuses.
void send_at_once(int connection) {
  const int yes = 1;
  ::setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
}

enum class Heard { nothing, something, end };

Heard listen_to(const Descriptor& socket) {
  char first = 0;
  const ssize_t bytes = ::recv(socket.get(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
  if (bytes > 0) return Heard::something;
  if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) return Heard::nothing;
  return Heard::end;
}

}  // namespace

SocketBudget socket_budget(std::size_t max_connections, std::size_t promised) {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  const std::size_t used = open_descriptors() + kKeptDescriptors + promised;
  constexpr std::size_t kLeast = 8;
  if (limit.rlim_cur < used + kLeast) {
    throw UsageError("the system allows " + std::to_string(limit.rlim_cur) +
                     " open files, the server needs " + std::to_string(used + kLeast) +
                     ": raise that limit (ulimit -n, LimitNOFILE)");
  }
  const std::size_t left = limit.rlim_cur - used;
  SocketBudget budget;
  budget.silent = std::min(kMostSilent, left / 4);
  budget.connections = std::min(max_connections, left - budget.silent);
  return budget;
}

Acceptor::Acceptor(std::vector<Descriptor> listening, SocketBudget budget, ConnectionLog& log,
                   Hooks hooks)
    : listening_(std::move(listening)),
      budget_(budget),
      log_(log),
      hooks_(std::move(hooks)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this] { run(); }) {}

bool Acceptor::has_turned_within(std::chrono::milliseconds time) const {
  return Clock::now() - last_turn_.load() < time + kTurn;
}

void Acceptor::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  ::eventfd_write(wake_.get(), 1);
  thread_.join();
  silent_.clear();
  listening_.clear();
}

void Acceptor::run() {
  while (!stopping_) {
    wait();
    last_turn_ = Clock::now();
    forget_closed();
    hand_over_who_spoke();
    accept_all();
    tell_room();
  }
}

void Acceptor::wait() {
  std::vector<pollfd> sockets{{wake_.get(), POLLIN, 0}};
  for (const Silent& each : silent_) sockets.push_back({each.socket.get(), POLLIN, 0});
  // Who waits to be accepted would wake it again and again.
  if (!is_starved_) {
    for (const Descriptor& each : listening_) sockets.push_back({each.get(), POLLIN, 0});
  }
  ::poll(sockets.data(), sockets.size(), static_cast<int>(kTurn.count()));
}

void Acceptor::hand_over_who_spoke() {
  const Clock::time_point now = Clock::now();
  std::deque<Silent> still_silent;
  for (Silent& each : silent_) {
    const Heard heard = listen_to(each.socket);
    if (heard == Heard::something) {
      hand_over(each);
    } else if (heard == Heard::nothing && now - each.since < kMostSilence) {
      still_silent.push_back(std::move(each));
    } else {
      ++log_.silent;
    }
  }
  silent_ = std::move(still_silent);
}

void Acceptor::hand_over(Silent& connection) {
  const std::optional<ino_t> inode = inode_of(connection.socket.get());
  if (!inode || handed_over_.size() >= budget_.connections) {
    ++log_.refused;
    return;
  }
  const int descriptor = connection.socket.release();
  handed_over_.push_back({descriptor, *inode});
  log_.open = handed_over_.size();
  hooks_.hand_over(descriptor, connection.listening);
}

void Acceptor::drop_the_oldest_silent() {
  silent_.pop_front();
  ++log_.silent;
}

void Acceptor::forget_closed() {
  std::erase_if(handed_over_,
                [](const HandedOver& each) { return inode_of(each.descriptor) != each.inode; });
  log_.open = handed_over_.size();
}

void Acceptor::accept_all() {
  is_starved_ = false;
  // In turns, so that a flood keeps nobody waiting who has spoken.
  constexpr int kMostAtOnce = 16;
  for (const Descriptor& each : listening_) {
    for (int i = 0; i < kMostAtOnce && accept_from(each); ++i) {
    }
  }
}

bool Acceptor::accept_from(const Descriptor& listening) {
  Descriptor socket(::accept4(listening.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket.is_open()) {
    if (errno == ECONNABORTED || errno == EINTR) return true;
    if (errno == EAGAIN) return false;
    spdlog::warn("event=cannot_accept error=\"{}\"", std::generic_category().message(errno));
    is_starved_ = true;
    if (!silent_.empty()) drop_the_oldest_silent();
    return false;
  }
  send_at_once(socket.get());
  if (silent_.size() >= budget_.silent) drop_the_oldest_silent();
  silent_.push_back({std::move(socket), listening.get(), Clock::now()});
  return true;
}

void Acceptor::tell_room() {
  const bool has_room = !is_starved_ && handed_over_.size() < budget_.connections;
  if (has_room == has_room_) return;
  has_room_ = has_room;
  if (has_room) {
    spdlog::info("event=room_for_clients connections={} refused={}", handed_over_.size(),
                 log_.refused.load());
  } else {
    spdlog::warn("event=no_room_for_clients connections={}", handed_over_.size());
  }
  hooks_.on_room(has_room);
}

}  // namespace nbvopt
