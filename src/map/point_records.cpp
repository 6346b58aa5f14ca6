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

std::string_view Words::next() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(separators_), rest_.size()));
  const std::string_view word = rest_.substr(0, rest_.find_first_of(separators_));
  rest_.remove_prefix(word.size());
  return word;
}

std::vector<std::string> Words::rest() {
  std::vector<std::string> words;
  for (std::string_view word = next(); !word.empty(); word = next()) words.emplace_back(word);
  return words;
}

std::optional<std::string> ScanInput::next_line() {
  constexpr std::size_t kMaxLine = 1 << 16;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  while (!in_.at_end()) {
    ++line_;
    auto line = in_.take_line(kMaxLine);
    if (!line) refuse_line("is longer than any line of such a file, it is damaged");
    if (line_ == 1 && line->starts_with(kByteOrderMark)) line->erase(0, kByteOrderMark.size());
    line->erase(line->find_last_not_of(" \t\r") + 1);
    if (!line->empty()) return line;
  }
  return std::nullopt;
}

std::string ScanInput::needed_line() {
  auto line = next_line();
  if (!line) refuse_end();
  return *std::move(line);
}

const char* ScanInput::take_bytes(std::size_t count) {
  const char* bytes = in_.take(count);
  if (bytes == nullptr) refuse_end();
  return bytes;
}

void ScanInput::parse_numbers(Words& words, std::span<double> numbers) const {
  for (double& number : numbers) {
    const std::string_view word = words.next();
    if (word.empty()) refuse_line("too few numbers, the file is damaged");
    const std::optional<double> value = parse_scan_number(word);
    if (!value) {
      refuse_line("'" + std::string(word.substr(0, 40)) + "' stands where a number was expected");
    }
    number = *value;
  }
}

void ScanInput::refuse_end() const {
  const std::string where = part_.empty() ? "after " + std::to_string(point_) + " of " +
                                                std::to_string(points_) + " points"
                                          : "within " + part_;
  refuse("the file ends too early, " + where + ": it is truncated or damaged");
}

void ScanInput::refuse(const std::string& what) const { throw InputError(name_ + ": " + what); }

void ScanInput::refuse_line(const std::string& what) const {
  refuse("line " + std::to_string(line_) + ": " + what);
}

std::optional<double> parse_scan_number(std::string_view word) {
  if (const auto number = parse_number(word)) return number;
  // As the C library of Windows used to print them: 1.#INF, -1.#IND, 1.#QNAN, 1.#INF00.
  const std::size_t mark = word.find("1.#");
  if (mark > 1 || (mark == 1 && word[0] != '-' && word[0] != '+')) return std::nullopt;
  if (!word.substr(mark + 3).starts_with("INF")) return std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  return word[0] == '-' ? -infinity : infinity;
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

PointFields::PointFields(std::vector<std::string> names, const ScanInput& in) {
  for (std::string& name : names) name = lower_case(std::move(name));
  const auto find = [&](const char* name) -> std::optional<std::size_t> {
    const auto at = std::ranges::find(names, name);
    if (at == names.end()) return std::nullopt;
    return at - names.begin();
  };
  const auto required = [&](const char* name) {
    const auto index = find(name);
    if (!index) in.refuse("the points have no '" + std::string(name) + "'");
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
