// A connection as the HTTP library reads and writes it, with an end to all that a client may do.
//
// The library itself waits for each byte anew, and keeps lines and headers without bound.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>
#include <string>

#include "core/descriptor.hpp"

namespace nbvopt {

/// One request and its answer. Beyond a limit the connection counts as broken.
class HttpStream final : public httplib::Stream {
 public:
  static constexpr std::size_t kMostRequestBytes = 8192;      ///< headers and all
  static constexpr std::chrono::seconds kMostRequestTime{5};  ///< until all of it must be there
  static constexpr std::size_t kPartBytes = std::size_t{1} << 20;

  /// `socket` must not block. `most_send` is how long the client may keep a part of kPartBytes of
  /// the answer waiting.
  HttpStream(const Descriptor& socket, std::chrono::milliseconds most_send)
      : socket_(socket), most_send_(most_send) {}

  /// Ends the answer and lets the client read it to its end: a connection that is closed while
  /// something of the client's is unread loses what is under way to it.
  void finish();

  bool is_readable() const override { return true; }
  /// Whether the client has taken all that it was sent; what its own system keeps for it counts as
  /// taken.
  bool is_writable() const override;
  ssize_t read(char* bytes, size_t size) override;
  ssize_t write(const char* bytes, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override { nobody(ip, port); }
  void get_local_ip_and_port(std::string& ip, int& port) const override { nobody(ip, port); }
  /// None: the library only asks whether select() could take it, which is not used.
  socket_t socket() const override { return INVALID_SOCKET; }

 private:
  using Clock = std::chrono::steady_clock;

  static void nobody(std::string& ip, int& port) {
    ip.clear();
    port = 0;
  }
  /// Receives more of the request. False: nothing more comes, or none may.
  bool receive();
  /// Whether the socket is ready in time.
  bool wait_for(short event, Clock::duration time) const;

  const Descriptor& socket_;
  const std::chrono::milliseconds most_send_;
  const Clock::time_point request_end_ = Clock::now() + kMostRequestTime;
  std::array<char, kMostRequestBytes> request_;
  std::size_t received_ = 0;
  std::size_t read_ = 0;
  std::size_t sent_of_part_ = 0;
  Clock::duration waited_for_part_{0};
};

}  // namespace nbvopt
