#include "server/web/http_stream.hpp"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace nbvopt {

bool HttpStream::wait_for(short event, Clock::duration time) const {
  const auto time_ms = std::chrono::ceil<std::chrono::milliseconds>(time).count();
  pollfd socket{socket_.get(), event, 0};
  return time_ms > 0 && ::poll(&socket, 1, static_cast<int>(time_ms)) > 0;
}

bool HttpStream::is_writable() const {
  int bytes = 0;
  return ::ioctl(socket_.get(), SIOCOUTQ, &bytes) == 0 && bytes == 0;
}

bool HttpStream::receive() {
  while (received_ < request_.size()) {
    const ssize_t bytes =
        ::recv(socket_.get(), request_.data() + received_, request_.size() - received_, 0);
    if (bytes > 0) {
      received_ += static_cast<std::size_t>(bytes);
      return true;
    }
    const bool may_come = bytes < 0 && (errno == EAGAIN || errno == EINTR);
    if (!may_come || !wait_for(POLLIN, request_end_ - Clock::now())) return false;
  }
  return false;
}

ssize_t HttpStream::read(char* bytes, size_t size) {
  if (read_ == received_ && !receive()) return -1;
  const std::size_t count = std::min(size, received_ - read_);
  std::copy_n(request_.data() + read_, count, bytes);
  read_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t HttpStream::write(const char* bytes, size_t size) {
  while (true) {
    const ssize_t sent = ::send(socket_.get(), bytes, size, MSG_NOSIGNAL);
    if (sent >= 0) {
      sent_of_part_ += static_cast<std::size_t>(sent);
      if (sent_of_part_ >= kPartBytes) {
        sent_of_part_ = 0;
        waited_for_part_ = {};
      }
      return sent;
    }
    if (errno == EINTR) continue;
    if (errno != EAGAIN) return -1;
    const Clock::time_point start = Clock::now();
    if (!wait_for(POLLOUT, most_send_ - waited_for_part_)) return -1;
    waited_for_part_ += Clock::now() - start;
  }
}

void HttpStream::finish() {
  ::shutdown(socket_.get(), SHUT_WR);
  constexpr std::chrono::seconds kMost{1};
  const Clock::time_point end = Clock::now() + kMost;
  while (wait_for(POLLIN, end - Clock::now())) {
    if (::recv(socket_.get(), request_.data(), request_.size(), 0) <= 0) return;
  }
}

}  // namespace nbvopt
