// What PLY and PCD files share: a text header, then points as records of named numbers.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "map/byte_reader.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// How a file stores one number.
enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t byte_size(NumberType type);

/// The number that starts at `bytes`.
double decoded_number(const char* bytes, NumberType type, std::endian order);

/// The words of a line, one after the other.
class Words {
 public:
  explicit Words(std::string_view line, std::string_view separators = " \t\r")
      : rest_(line), separators_(separators) {}

  /// The next word; empty at the end.
  std::string_view next();

  /// All words that are left.
  std::vector<std::string> rest();

 private:
  std::string_view rest_, separators_;
};

/// A scan file, read from its start: lines, which are counted, and then perhaps bytes.
class ScanInput {
 public:
  /// `name` stands for the file in messages.
  ScanInput(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  /// The next line that holds anything, without its end and the mark that Windows editors put at a
  /// file's start; none at the file's end. Throws InputError for a line without end.
  std::optional<std::string> next_line();

  /// The same of a part that must go on. Throws InputError at the file's end, which tells where
  /// that is.
  std::string needed_line();

  /// The next bytes. Throws InputError at the file's end, which tells where that is.
  const char* take_bytes(std::size_t count);

  /// Says what is read next, for messages: "its header", or a record of so many.
  void enter(const std::string& part) { part_ = part; }
  void enter_point(std::uint64_t index, std::uint64_t count) {
    part_.clear();
    point_ = index;
    points_ = count;
  }

  /// Fills `numbers` with the next words of the line that was read last. Throws InputError when
  /// there are too few or one is not a number.
  void parse_numbers(Words& words, std::span<double> numbers) const;

  const std::string& name() const { return name_; }

  /// Throws InputError about the file, and about the line that was read last.
  [[noreturn]] void refuse(const std::string& what) const;
  [[noreturn]] void refuse_line(const std::string& what) const;

 private:
  [[noreturn]] void refuse_end() const;

  ByteReader in_;
  const std::string& name_;
  std::uint64_t line_ = 0;
  std::string part_ = "its header";  ///< empty: within the points
  std::uint64_t point_ = 0, points_ = 0;
};

/// The number that a word is; "nan" and "inf" as any system prints them, too.
std::optional<double> parse_scan_number(std::string_view word);

std::string lower_case(std::string text);

/// Where a record has what a scan needs, as indices of its numbers. Names are compared whatever
/// their case.
class PointFields {
 public:
  /// Throws InputError unless x, y and z are among the names.
  PointFields(std::vector<std::string> names, const ScanInput& in);

  /// Adds a point from a record's numbers; with a colour when the record has one.
  void add(std::span<const double> record, Scan& scan) const;

 private:
  std::size_t x_, y_, z_;
  std::optional<std::size_t> red_, green_, blue_, packed_colour_;
};

}  // namespace nbvopt
