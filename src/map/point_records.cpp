#include "map/point_records.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

template <class Number>
double decoded(const char* bytes, std::endian order) {
  char native[sizeof(Number)];
  std::memcpy(native, bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(native, native + sizeof(Number));
  return static_cast<double>(number_at<Number>(native));
}

/// The whole part of a value that should fit; 0 where it does not.
template <class Whole>
Whole whole(double value) {
  const bool fits = value >= 0.0 && value <= std::numeric_limits<Whole>::max();
  return fits ? static_cast<Whole>(value) : Whole{0};
}

}  // namespace

std::size_t byte_size(NumberType type) {
  switch (type) {
    case NumberType::i8:
    case NumberType::u8:
      return 1;
    case NumberType::i16:
    case NumberType::u16:
      return 2;
    case NumberType::i32:
    case NumberType::u32:
    case NumberType::f32:
      return 4;
    case NumberType::i64:
    case NumberType::u64:
    case NumberType::f64:
      return 8;
  }
  return 0;
}

double decoded_number(const char* bytes, NumberType type, std::endian order) {
  switch (type) {
    case NumberType::i8:
      return decoded<std::int8_t>(bytes, order);
    case NumberType::u8:
      return decoded<std::uint8_t>(bytes, order);
    case NumberType::i16:
      return decoded<std::int16_t>(bytes, order);
    case NumberType::u16:
      return decoded<std::uint16_t>(bytes, order);
    case NumberType::i32:
      return decoded<std::int32_t>(bytes, order);
    case NumberType::u32:
      return decoded<std::uint32_t>(bytes, order);
    case NumberType::i64:
      return decoded<std::int64_t>(bytes, order);
    case NumberType::u64:
      return decoded<std::uint64_t>(bytes, order);
    case NumberType::f32:
      return decoded<float>(bytes, order);
    case NumberType::f64:
      return decoded<double>(bytes, order);
  }
  return 0.0;
}

void parse_numbers(std::string_view line, std::span<double> numbers, const std::string& name) {
  constexpr const char* kSpaces = " \t\r";
  for (double& number : numbers) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpaces), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kSpaces));
    if (word.empty()) throw InputError(name + ": a point has too few numbers, the file is damaged");
    const std::optional<double> value = parse_number(word);
    if (!value) {
      throw InputError(name + ": '" + std::string(word.substr(0, 40)) +
                       "' stands where a number was expected");
    }
    number = *value;
    line.remove_prefix(word.size());
  }
}

std::string take_text_line(ByteReader& in, const std::string& name) {
  constexpr std::size_t kMaxLine = 1 << 16;
  auto line = in.take_line(kMaxLine);
  if (!line) throw InputError(name + ": the file ends too early, it is truncated or damaged");
  if (line->ends_with('\r')) line->pop_back();
  return *std::move(line);
}

const char* take_bytes(ByteReader& in, std::size_t count, const std::string& name) {
  const char* bytes = in.take(count);
  if (bytes == nullptr) throw InputError(name + ": the file ends too early, it is truncated");
  return bytes;
}

PointFields::PointFields(const std::vector<std::string>& names, const std::string& file) {
  const auto find = [&](const char* name) -> std::optional<std::size_t> {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) return std::nullopt;
    return at - names.begin();
  };
  const auto required = [&](const char* name) {
    const auto index = find(name);
    if (!index) throw InputError(file + ": the points have no '" + name + "'");
    return *index;
  };
  x_ = required("x");
  y_ = required("y");
  z_ = required("z");
  red_ = find("red");
  green_ = find("green");
  blue_ = find("blue");
  packed_colour_ = find("rgb");
  if (!packed_colour_) packed_colour_ = find("rgba");
}

void PointFields::add(std::span<const double> record, Scan& scan) const {
  scan.points_m.push_back(Eigen::Vector3d(record[x_], record[y_], record[z_]).cast<float>());
  if (red_ && green_ && blue_) {
    scan.colours.push_back({whole<std::uint8_t>(record[*red_]),
                            whole<std::uint8_t>(record[*green_]),
                            whole<std::uint8_t>(record[*blue_])});
  } else if (packed_colour_) {
    const auto bits = whole<std::uint32_t>(record[*packed_colour_]);
    scan.colours.push_back({static_cast<std::uint8_t>(bits >> 16 & 0xFF),
                            static_cast<std::uint8_t>(bits >> 8 & 0xFF),
                            static_cast<std::uint8_t>(bits & 0xFF)});
  }
}

}  // namespace nbvopt
