// Checks of options: one that fails names the field, its value and what it must be.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// Throws InputError "<field> is <value>, it must be <demand>" unless the value is finite and
/// `holds`.
inline void check_field(bool holds, std::string_view field, double value, std::string_view demand) {
  if (holds && std::isfinite(value)) return;
  throw InputError(std::string(field) + " is " + format_number(value) + ", it must be " +
                   std::string(demand));
}

}  // namespace nbvopt
