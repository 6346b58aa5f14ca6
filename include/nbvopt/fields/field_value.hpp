// Named values of files and messages, on their way into typed fields.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace nbvopt {

/// A value whose type has not been checked yet. Enumerators are strings; vectors lists of numbers.
using FieldValue = std::variant<bool, double, std::string, std::vector<double>>;

/// One "key: value" of a file.
struct FieldSetting {
  std::string key;
  FieldValue value;

  bool operator==(const FieldSetting&) const = default;
};

}  // namespace nbvopt
