// What PLY and PCD files share: points as records of named numbers.
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

/// Fills `numbers` with the first words of a line. Throws InputError when there are too few or
/// one is not a number.
void parse_numbers(std::string_view line, std::span<double> numbers, const std::string& name);

/// The lines of a text part, without their ends. Throws InputError when the file ends too early.
std::string take_text_line(ByteReader& in, const std::string& name);

/// The next bytes of a file. Throws InputError when it ends before.
const char* take_bytes(ByteReader& in, std::size_t count, const std::string& name);

/// Where a record has what a scan needs, as indices of its numbers.
class PointFields {
 public:
  /// Throws InputError unless x, y and z are among the names.
  PointFields(const std::vector<std::string>& names, const std::string& file);

  /// Adds a point from a record's numbers; with a colour when the record has one.
  void add(std::span<const double> record, Scan& scan) const;

 private:
  std::size_t x_, y_, z_;
  std::optional<std::size_t> red_, green_, blue_, packed_colour_;
};

}  // namespace nbvopt
