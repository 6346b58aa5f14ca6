#include "server/listen_address.hpp"

#include <arpa/inet.h>
#include <sys/un.h>

#include <string_view>

#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::string_view kUnix = "unix:";

[[noreturn]] void refuse(const std::string& field, const std::string& text, const char* why) {
  throw UsageError(field + ": '" + text + "' " + why);
}

}  // namespace

bool is_loopback(const std::string& host) {
  if (host == "localhost") return true;
  in_addr v4{};
  if (::inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  in6_addr v6{};
  return ::inet_pton(AF_INET6, host.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

ListenAddress parse_listen_address(const std::string& text, const std::string& field) {
  if (text.starts_with(kUnix)) {
    const std::string path = text.substr(kUnix.size());
    if (path.empty()) refuse(field, text, "names no socket, write unix:PATH");
    if (path.size() >= sizeof(sockaddr_un::sun_path)) {
      refuse(field, text, "is too long for a socket's path, which holds 107 bytes");
    }
    return {text, path, true};
  }
  const std::size_t colon = text.rfind(':');
  const auto port =
      colon == std::string::npos ? std::nullopt : parse_whole_number(text.substr(colon + 1));
  if (!port || *port > 65535 || colon == 0) {
    refuse(field, text, "is no address, write HOST:PORT or unix:PATH");
  }
  std::string host = text.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  return {text, std::nullopt, is_loopback(host)};
}

void check_tls(const ListenAddress& address, const TlsFiles& tls) {
  if (address.is_local) {
    if (!tls.is_empty())
      refuse("listen", address.text, "is of this machine only and needs no certificates");
    return;
  }
  if (tls.certificate.empty() || tls.key.empty() || tls.client_ca.empty()) {
    refuse("listen", address.text,
           "can be reached from other machines: give a certificate, its key and the client CA");
  }
}

}  // namespace nbvopt
