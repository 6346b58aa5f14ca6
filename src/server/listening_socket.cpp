#include "server/listening_socket.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const ListenAddress& address, const std::string& why) {
  throw InputError("cannot listen on " + address.text + ": " + why);
}

std::string reason(int error) { return std::generic_category().message(error); }

/// Files made meanwhile, sockets too, are nobody else's.
class PrivateFiles {
 public:
  PrivateFiles() : before_(::umask(0177)) {}
  PrivateFiles(const PrivateFiles&) = delete;
  PrivateFiles& operator=(const PrivateFiles&) = delete;
  ~PrivateFiles() { ::umask(before_); }

 private:
  mode_t before_;
};

Descriptor new_socket(int family) {
  return Descriptor(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

/// 0, or the error that kept it from listening there.
int bind_and_listen(const Descriptor& socket, const sockaddr* where, socklen_t length) {
  if (!socket.is_open()) return errno;
  if (::bind(socket.get(), where, length) != 0) return errno;
  return ::listen(socket.get(), SOMAXCONN) == 0 ? 0 : errno;
}

Descriptor listen_on_unix_socket(const ListenAddress& address) {
  const fs::path& path = *address.socket;
  std::error_code ignored;
  if (fs::is_socket(fs::symlink_status(path, ignored))) fs::remove(path, ignored);
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  std::strncpy(where.sun_path, path.c_str(), sizeof(where.sun_path) - 1);
  Descriptor socket = new_socket(AF_UNIX);
  const PrivateFiles only_mine;
  const int error =
      bind_and_listen(socket, reinterpret_cast<const sockaddr*>(&where), sizeof(where));
  if (error != 0) refuse(address, reason(error));
  return socket;
}

using AddressList = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

AddressList resolve(const ListenAddress& address, std::string host, const std::string& port) {
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (error != 0) refuse(address, ::gai_strerror(error));
  return {found, &::freeaddrinfo};
}

/// The port is the last part of all addresses of TCP.
in_port_t& port_of(sockaddr& address) {
  return address.sa_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(address).sin6_port
                                       : reinterpret_cast<sockaddr_in&>(address).sin_port;
}

in_port_t bound_port(const Descriptor& socket) {
  sockaddr_storage bound{};
  socklen_t length = sizeof(bound);
  auto& address = reinterpret_cast<sockaddr&>(bound);
  ::getsockname(socket.get(), &address, &length);
  return port_of(address);
}

std::vector<Descriptor> listen_on_tcp(ListenAddress& address) {
  const std::size_t colon = address.text.rfind(':');
  const AddressList addresses =
      resolve(address, address.text.substr(0, colon), address.text.substr(colon + 1));
  std::vector<Descriptor> sockets;
  int last_error = 0;
  in_port_t port = 0;  // the same for all addresses of a name
  for (addrinfo* each = addresses.get(); each != nullptr; each = each->ai_next) {
    Descriptor socket = new_socket(each->ai_family);
    const int yes = 1;  // or a restart would wait until the last connections are forgotten
    ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    if (port != 0) port_of(*each->ai_addr) = port;
    const int error = bind_and_listen(socket, each->ai_addr, each->ai_addrlen);
    if (error == EADDRINUSE) refuse(address, reason(error));
    if (error != 0) {  // such as that of IPv6, where the system has none
      last_error = error;
      continue;
    }
    port = bound_port(socket);
    sockets.push_back(std::move(socket));
  }
  if (sockets.empty()) refuse(address, reason(last_error));
  address.text.replace(colon + 1, std::string::npos, std::to_string(ntohs(port)));
  return sockets;
}

}  // namespace

std::vector<Descriptor> listen_on(ListenAddress& address) {
  if (!address.socket) return listen_on_tcp(address);
  std::vector<Descriptor> sockets;
  sockets.push_back(listen_on_unix_socket(address));
  return sockets;
}

}  // namespace nbvopt
