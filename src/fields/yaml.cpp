#include "fields/yaml.hpp"

#include "core/number.hpp"
#include "fields/keys.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

FieldValue scalar_value(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // quoted: a string whatever it looks like
  if (text == "true" || text == "false") return text == "true";
  if (const auto number = parse_number(text)) return *number;
  return text;
}

}  // namespace

YAML::Node parse_yaml(const std::string& text, const std::string& name) {
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(name + ": line " + std::to_string(error.mark.line + 1) +
                     ": not valid YAML: " + error.msg);
  }
}

FieldValue field_value(const YAML::Node& node, const std::string& field) {
  if (node.IsScalar()) return scalar_value(node);
  if (!node.IsSequence()) refuse_missing_value(field);
  std::vector<double> list;
  for (const YAML::Node& element : node) {
    const auto number = element.IsScalar() ? parse_number(element.Scalar()) : std::nullopt;
    if (!number) throw InputError(field + " must be a list of numbers");
    list.push_back(*number);
  }
  return list;
}

std::string to_yaml(const FieldValue& value) {
  struct Writer {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(double x) const { return format_number(x); }
    std::string operator()(const std::string& x) const { return x; }
    std::string operator()(const std::vector<double>& list) const {
      std::string text;
      for (const double x : list) text += (text.empty() ? "[" : ", ") + format_number(x);
      return text + "]";
    }
  };
  return std::visit(Writer{}, value);
}

}  // namespace nbvopt
