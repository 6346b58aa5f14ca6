// Plain values as bytes and back, on one kind of machine.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// FNV-1a, 64 bits.
inline std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// Values whose bytes are all that they are.
template <class T>
concept PlainValue = std::is_trivially_copyable_v<T> || std::is_same_v<T, Eigen::Vector3f>;

/// Appends values to a text of bytes.
class ArchiveWriter {
 public:
  template <PlainValue T>
  void operator()(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <PlainValue T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(std::uint64_t{text.size()});
    bytes_ += text;
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    for (const T& value : values) (*this)(value);
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ArchiveWriter wrote, in its order. Throws InputError where the bytes end early.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::string_view bytes) : rest_(bytes) {}

  template <PlainValue T>
  void operator()(T& value) {
    const std::string_view bytes = take(sizeof(T));
    std::ranges::copy(bytes, reinterpret_cast<char*>(&value));
  }
  template <PlainValue T>
  void operator()(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    std::ranges::copy(take(values.size() * sizeof(T)), reinterpret_cast<char*>(values.data()));
  }
  void operator()(std::string& text) { text = take(count(1)); }
  template <class T>
  void operator()(std::vector<T>& values) {
    values.resize(count(1));
    for (T& value : values) (*this)(value);
  }

  std::string_view rest() const { return rest_; }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw InputError("the bytes end early");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  /// A number of elements that can still follow.
  std::size_t count(std::size_t element_size) {
    std::uint64_t value = 0;
    (*this)(value);
    if (value > rest_.size() / element_size) throw InputError("the bytes end early");
    return value;
  }

  std::string_view rest_;
};

}  // namespace nbvopt
