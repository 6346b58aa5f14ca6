#include "fields/store.hpp"

#include <cmath>
#include <limits>

#include "core/number.hpp"

namespace nbvopt {

std::string to_text(const FieldValue& value) {
  struct Writer {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(double x) const { return format_number(x); }
    std::string operator()(const std::string& x) const { return "'" + x + "'"; }
    std::string operator()(const std::vector<double>& x) const {
      return "a list of " + std::to_string(x.size()) + " numbers";
    }
  };
  return std::visit(Writer{}, value);
}

std::string store(const FieldValue& value, bool& field) {
  const auto* truth = std::get_if<bool>(&value);
  if (truth == nullptr) return "true or false";
  field = *truth;
  return {};
}

std::string store(const FieldValue& value, double& field) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return "a number";
  field = *number;
  return {};
}

std::string store(const FieldValue& value, std::int64_t& field) {
  constexpr double kMostExact = 0x1p53;
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr || *number != std::floor(*number) || std::abs(*number) >= kMostExact) {
    return "a whole number";
  }
  field = static_cast<std::int64_t>(*number);
  return {};
}

std::string store(const FieldValue& value, int& field) {
  std::int64_t whole = 0;
  if (!store(value, whole).empty() || std::abs(whole) > std::numeric_limits<int>::max()) {
    return "a whole number";
  }
  field = static_cast<int>(whole);
  return {};
}

std::string store(const FieldValue& value, std::string& field) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return "a word";
  field = *text;
  return {};
}

std::string store(const FieldValue& value, Eigen::Vector3d& field) {
  const auto* list = std::get_if<std::vector<double>>(&value);
  if (list == nullptr || list->size() != 3) return "a list of three numbers";
  field << (*list)[0], (*list)[1], (*list)[2];
  return {};
}

}  // namespace nbvopt
