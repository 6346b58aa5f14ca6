// Reads a binary stream by large blocks and gives small pieces of it without copying.
#pragma once

#include <cstddef>
#include <cstring>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace nbvopt {

/// Numbers are read in the machine's byte order, which is little-endian wherever this builds.
class ByteReader {
 public:
  explicit ByteReader(std::istream& in) : in_(in), buffer_(kBlockBytes) {}

  /// The next `count` bytes, which are not taken, valid until the next call; nullptr when the
  /// stream ends before.
  const char* peek(std::size_t count) {
    return count > available_ && !refill(count) ? nullptr : next_;
  }

  /// Whether these bytes come next; they are not taken.
  bool begins_with(std::string_view bytes) {
    const char* next = peek(bytes.size());
    return next != nullptr && std::string_view(next, bytes.size()) == bytes;
  }

  /// Whether all bytes were taken.
  bool at_end() { return peek(1) == nullptr; }

  /// The same, taken.
  const char* take(std::size_t count) {
    const char* piece = peek(count);
    if (piece == nullptr) return nullptr;
    next_ += count;
    available_ -= count;
    return piece;
  }

  /// The bytes up to the next newline, which is taken but not returned, or to the stream's end.
  /// None at the end, or when the line has more than `max_length` bytes.
  std::optional<std::string> take_line(std::size_t max_length) {
    std::string line;
    while (line.size() <= max_length) {
      const char* c = take(1);
      if (c == nullptr && line.empty()) return std::nullopt;
      if (c == nullptr || *c == '\n') return line;
      line += *c;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

  bool refill(std::size_t count) {
    if (count > buffer_.size()) buffer_.resize(count);
    if (available_ > 0) std::memmove(buffer_.data(), next_, available_);
    in_.read(buffer_.data() + available_,
             static_cast<std::streamsize>(buffer_.size() - available_));
    available_ += static_cast<std::size_t>(in_.gcount());
    next_ = buffer_.data();
    return count <= available_;
  }

  std::istream& in_;
  std::vector<char> buffer_;
  const char* next_ = nullptr;
  std::size_t available_ = 0;
};

/// A number that starts at `bytes`, which need not be aligned.
template <class Number>
requires std::is_trivially_copyable_v<Number> Number number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof(Number));
  return number;
}

}  // namespace nbvopt
