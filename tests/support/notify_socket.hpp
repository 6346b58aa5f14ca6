// A service manager's ear: the socket that NOTIFY_SOCKET names.
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstddef>
#include <stdexcept>
#include <string>

#include "core/descriptor.hpp"

namespace nbvopt::test {

class NotifySocket {
 public:
  /// A path, or '@' and the name of an abstract socket.
  explicit NotifySocket(const std::string& name) : socket_(::socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un where{};
    where.sun_family = AF_UNIX;
    name.copy(where.sun_path, sizeof(where.sun_path) - 1);
    if (name.starts_with('@')) where.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    if (::bind(socket_.get(), reinterpret_cast<sockaddr*>(&where), length) != 0) {
      throw std::runtime_error("no socket " + name);
    }
  }

  /// The next message; empty where none comes within a minute.
  std::string next() const {
    constexpr int kMost_ms = 60'000;
    if (!has_more(kMost_ms)) return {};
    std::string message(1000, '\0');
    const ssize_t bytes = ::recv(socket_.get(), message.data(), message.size(), 0);
    message.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes));
    return message;
  }

  bool has_more(int wait_ms = 0) const {
    pollfd readable{socket_.get(), POLLIN, 0};
    return ::poll(&readable, 1, wait_ms) == 1;
  }

 private:
  Descriptor socket_;
};

}  // namespace nbvopt::test
