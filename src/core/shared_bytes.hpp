// Bytes in pieces that others may hold, too.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nbvopt {

/// Copies share the pieces, which never change.
class SharedBytes {
 public:
  using Piece = std::shared_ptr<const std::string>;

  SharedBytes() = default;
  explicit SharedBytes(std::string bytes) { append(std::move(bytes)); }
  explicit SharedBytes(Piece piece) { append(std::move(piece)); }

  void append(Piece piece) {
    size_ += piece->size();
    pieces_.push_back(std::move(piece));
  }
  void append(std::string bytes) { append(std::make_shared<const std::string>(std::move(bytes))); }

  std::size_t size() const { return size_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  std::vector<std::string_view> views() const {
    std::vector<std::string_view> views;
    for (const Piece& piece : pieces_) views.emplace_back(*piece);
    return views;
  }

  std::string joined() const {
    std::string bytes;
    bytes.reserve(size_);
    for (const Piece& piece : pieces_) bytes += *piece;
    return bytes;
  }

 private:
  std::vector<Piece> pieces_;
  std::size_t size_ = 0;
};

/// Makes pieces and knows what all of them take that anybody holds still. Safe to share between
/// threads; pieces may outlive it.
class HeldBytes {
 public:
  SharedBytes::Piece hold(std::string bytes) const {
    bytes.shrink_to_fit();
    auto piece = std::make_unique<const std::string>(std::move(bytes));
    *bytes_ += piece->capacity();
    return {piece.release(), [all = bytes_](const std::string* last) {
              *all -= last->capacity();
              delete last;
            }};
  }

  std::uint64_t bytes() const { return *bytes_; }

 private:
  std::shared_ptr<std::atomic<std::uint64_t>> bytes_ =
      std::make_shared<std::atomic<std::uint64_t>>(0);
};

}  // namespace nbvopt
