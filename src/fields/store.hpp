// Values of files into typed fields, and back.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "core/enum_names.hpp"
#include "nbvopt/fields/field_value.hpp"

namespace nbvopt {

/// The value as messages show it.
std::string to_text(const FieldValue& value);

// store() writes the value into the field and gives an empty text; where it cannot, it leaves the
// field alone and says what the value must be, such as "a whole number".

std::string store(const FieldValue& value, bool& field);
std::string store(const FieldValue& value, double& field);
std::string store(const FieldValue& value, int& field);
std::string store(const FieldValue& value, std::int64_t& field);
std::string store(const FieldValue& value, std::string& field);
std::string store(const FieldValue& value, Eigen::Vector3d& field);

template <class Enum>
requires std::is_enum_v<Enum> std::string store(const FieldValue& value, Enum& field) {
  const auto* word = std::get_if<std::string>(&value);
  if (const auto known = word ? enum_value<Enum>(*word) : std::nullopt) {
    field = *known;
    return {};
  }
  std::string demand;
  for (const std::string& name : enum_names<Enum>()) {
    demand += (demand.empty() ? "one of " : ", ") + name;
  }
  return demand;
}

template <class Value>
std::string store(const FieldValue& value, std::optional<Value>& field) {
  Value given{};
  std::string demand = store(value, given);
  if (demand.empty()) field = given;
  return demand;
}

// value_of() is the way back; none where a field is not set.

template <class Number>
requires std::is_arithmetic_v<Number> std::optional<FieldValue> value_of(Number field) {
  if constexpr (std::is_same_v<Number, bool>) {
    return field;
  } else {
    return static_cast<double>(field);
  }
}
template <class Enum>
requires std::is_enum_v<Enum> std::optional<FieldValue> value_of(Enum field) {
  return std::string(enum_name(field));
}
inline std::optional<FieldValue> value_of(const std::string& field) { return field; }
inline std::optional<FieldValue> value_of(const Eigen::Vector3d& field) {
  return std::vector<double>(field.begin(), field.end());
}
template <class Value>
std::optional<FieldValue> value_of(const std::optional<Value>& field) {
  return field ? value_of(*field) : std::nullopt;
}

}  // namespace nbvopt
