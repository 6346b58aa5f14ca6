// Numbers that a message must give.
#pragma once

#include <string>

#include "core/field_check.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// The field's value. Throws an InputError that names it where it is not set or not finite.
inline double needed(bool is_set, double value, const std::string& field) {
  if (!is_set) throw InputError(field + " is not set");
  check_field(true, field, value, "finite");
  return value;
}

}  // namespace nbvopt
