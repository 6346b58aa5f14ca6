// A client that sends what it likes and keeps what comes back.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <string>

#include "core/descriptor.hpp"

namespace nbvopt::test {

/// A connection to the port of a web server's address "http://127.0.0.1:PORT/".
inline Descriptor connect_to(const std::string& url) {
  Descriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
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
