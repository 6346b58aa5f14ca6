// A client that sends what it likes and keeps what comes back.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <string>

#include "core/descriptor.hpp"

namespace nbvopt::test {

/// A connection to the port of a web server's address "http://127.0.0.1:PORT/". The system keeps
/// some `receive_bytes` for it of what it does not read; 0: as many as is usual.
inline Descriptor connect_to(const std::string& url, int receive_bytes = 0) {
  Descriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
  if (receive_bytes > 0) {
    ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof(receive_bytes));
  }
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  where.sin_port = htons(static_cast<in_port_t>(std::stoi(url.substr(url.rfind(':') + 1))));
  EXPECT_EQ(::connect(socket.get(), reinterpret_cast<const sockaddr*>(&where), sizeof(where)), 0);
  return socket;
}

/// Sends as much as the server takes.
inline void send_all(const Descriptor& socket, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count =
        ::send(socket.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

/// What comes until the other end closes.
inline std::string receive_all(const Descriptor& socket) {
  std::string all;
  char bytes[4096];
  for (ssize_t count = 0; (count = ::recv(socket.get(), bytes, sizeof(bytes), 0)) > 0;) {
    all.append(bytes, static_cast<std::size_t>(count));
  }
  return all;
}

/// What comes up to the first `end`, or until the other end closes.
inline std::string receive_until(const Descriptor& socket, const std::string& end) {
  std::string all;
  char byte = 0;
  while (!all.ends_with(end) && ::recv(socket.get(), &byte, 1, 0) > 0) all += byte;
  return all;
}

inline std::string answer_to(const std::string& url, const std::string& request) {
  const Descriptor socket = connect_to(url);
  send_all(socket, request);
  return receive_all(socket);
}

inline std::string get(const std::string& url, const std::string& path,
                       const std::string& headers = "Host: localhost\r\n") {
  return answer_to(url, "GET " + path + " HTTP/1.1\r\n" + headers + "\r\n");
}

}  // namespace nbvopt::test
