#include "experiment/line_channel.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace nbvopt::experiment {

bool LineReader::read_some() {
  std::array<char, 65536> buffer;
  ssize_t count = -1;
  do {
    count = ::read(descriptor_, buffer.data(), buffer.size());
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  bytes_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

std::optional<std::string> LineReader::next_line() {
  const std::size_t end = bytes_.find('\n', searched_);
  if (end == std::string::npos) {
    searched_ = bytes_.size();
    return std::nullopt;
  }
  std::string line = bytes_.substr(0, end);
  bytes_.erase(0, end + 1);
  searched_ = 0;
  return line;
}

std::optional<std::string> LineReader::wait_for_line() {
  while (true) {
    if (auto line = next_line()) return line;
    if (!read_some()) return std::nullopt;
  }
}

void write_line(int descriptor, std::string_view line) {
  std::string bytes(line);
  bytes += '\n';
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const ssize_t count = ::write(descriptor, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw std::system_error(errno, std::generic_category(), "line not written");
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace nbvopt::experiment
