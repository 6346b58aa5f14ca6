// Numbers that callers give. Throws InputError that names the argument.
#pragma once

#include <cstdint>
#include <string>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::python {

inline double non_negative(double value, const std::string& name) {
  if (value >= 0.0) return value;
  throw InputError(name + " is " + format_number(value) + ", it must be 0 or more");
}

inline std::uint64_t seed_from(std::int64_t seed) {
  if (seed >= 0) return static_cast<std::uint64_t>(seed);
  throw InputError("seed is " + std::to_string(seed) + ", it must be 0 or more");
}

}  // namespace nbvopt::python
