#include "core/number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace nbvopt {

std::optional<double> parse_number(std::string_view text) {
  // from_chars knows no leading plus, which people type.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string format_number(double value) {
  std::array<char, 32> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string decimal(double value, int digits) {
  const double unit = std::pow(10.0, -digits);
  const bool negative = value <= -0.5 * unit;  // "-0.00" is 0.00
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.*f", digits, std::abs(value));
  return (negative ? "\u2212" : "") + std::string(buffer);
}

std::string grouped(double value) {
  std::string text = decimal(value, 0);
  const std::size_t first = text.find_first_of("0123456789");
  for (std::size_t i = text.size(); i > first + 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

}  // namespace nbvopt
