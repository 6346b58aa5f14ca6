// Numbers as text: read strictly, written so that reading them back gives the same bits, or rounded
// for people.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace nbvopt {

/// The decimal number that the whole text is, "inf" and "nan" included; none for anything else.
std::optional<double> parse_number(std::string_view text);

/// The shortest decimal that reads back as the same number.
std::string format_number(double value);

/// A number for people: fixed digits, a true minus sign.
std::string decimal(double value, int digits);

/// 1234567 as "1,234,567", rounded.
std::string grouped(double value);

}  // namespace nbvopt
