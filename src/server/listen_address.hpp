// Where a server listens, and who may reach it there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace nbvopt {

/// The certificates of a server that is to be reached from other machines, PEM files.
struct TlsFiles {
  std::filesystem::path certificate;  ///< the server's own
  std::filesystem::path key;          ///< the server's own
  std::filesystem::path client_ca;    ///< signs the certificates of those who may call

  bool operator==(const TlsFiles&) const = default;
  bool is_empty() const { return *this == TlsFiles{}; }
};

struct ListenAddress {
  std::string text;                             ///< as gRPC wants it
  std::optional<std::filesystem::path> socket;  ///< of a Unix socket
  bool is_local = false;  ///< a Unix socket or a loopback address: this machine only
};

/// Whether a host's name or address, without brackets, is this machine's own.
bool is_loopback(const std::string& host);

/// "unix:PATH" or "HOST:PORT". Throws UsageError, which names `field`, for anything else.
ListenAddress parse_listen_address(const std::string& text, const std::string& field = "listen");

/// Throws UsageError where an address that others can reach comes without all three files, or a
/// local one with any.
void check_tls(const ListenAddress& address, const TlsFiles& tls);

}  // namespace nbvopt
