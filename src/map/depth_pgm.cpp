#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "map/byte_reader.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

/// Netpbm's PGM: words with white space and comments between them, then 16-bit values, high byte
/// first (P5), or as words (P2).
class PgmReader {
 public:
  PgmReader(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  Scan read(const DepthImageOptions& options) {
    const std::string magic = next_word();
    if (magic != "P5" && magic != "P2") refuse("this is not a PGM image");
    const std::uint64_t width = next_number("width", kMaxSide);
    const std::uint64_t height = next_number("height", kMaxSide);
    if (next_number("greatest value", UINT16_MAX) <= UINT8_MAX) {
      refuse("this PGM is no depth image: 16 bits of grey a pixel are needed");
    }
    Scan scan;
    std::vector<std::uint16_t> row(width);
    for (std::uint32_t v = 0; v < height; ++v) {
      if (magic == "P5") {
        read_bytes(row);
      } else {
        for (auto& depth : row) {
          depth = static_cast<std::uint16_t>(next_number("pixel", UINT16_MAX));
        }
      }
      append_depth_row(row, v, options, scan);
    }
    return scan;
  }

 private:
  static constexpr std::uint64_t kMaxSide = 65536;

  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + ": " + what); }

  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  const char* needed(const char* bytes) const {
    if (bytes == nullptr) refuse("the image ends too early, it is truncated");
    return bytes;
  }

  /// Takes one white space after the word, too, as the format has it before the pixels.
  std::string next_word() {
    constexpr std::size_t kMaxWord = 16;
    std::string word;
    while (word.size() <= kMaxWord) {
      const char* next = in_.take(1);
      if (next == nullptr && !word.empty()) return word;
      const char c = *needed(next);
      if (c == '#' && word.empty()) {
        pass_comment();
      } else if (!is_space(c)) {
        word += c;
      } else if (!word.empty()) {
        return word;
      }
    }
    refuse("'" + word + "' stands where a number was expected");
  }

  void pass_comment() {
    while (*needed(in_.take(1)) != '\n') {
    }
  }

  std::uint64_t next_number(const char* what, std::uint64_t most) {
    const std::string word = next_word();
    const auto number = parse_whole_number(word);
    if (!number || *number > most) {
      refuse("the image's " + std::string(what) + " is '" + word + "', a whole number up to " +
             std::to_string(most) + " was expected");
    }
    return *number;
  }

  void read_bytes(std::vector<std::uint16_t>& row) {
    const char* bytes = needed(in_.take(2 * row.size()));
    for (auto& depth : row) {
      const auto high = static_cast<std::uint8_t>(*bytes++);
      const auto low = static_cast<std::uint8_t>(*bytes++);
      depth = static_cast<std::uint16_t>(high << 8 | low);
    }
  }

  ByteReader in_;
  const std::string& name_;
};

}  // namespace

Scan read_depth_pgm(std::istream& in, const std::string& name, const DepthImageOptions& options) {
  options.validate();
  return PgmReader(in, name).read(options);
}

}  // namespace nbvopt
