#include "planner/yaml_value.hpp"

#include "core/number.hpp"
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
  if (!node.IsSequence()) throw InputError(field + " has no value, give one or leave the key out");
  std::vector<double> list;
  for (const YAML::Node& element : node) {
    const auto number = element.IsScalar() ? parse_number(element.Scalar()) : std::nullopt;
    if (!number) throw InputError(field + " must be a list of numbers");
    list.push_back(*number);
  }
  return list;
}

}  // namespace nbvopt
