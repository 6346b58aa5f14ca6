// YAML files whose scalars are typed by what they look like.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "nbvopt/fields/field_value.hpp"

namespace nbvopt {

/// The first document: LoadAll() of yaml-cpp 0.7 never ends on some texts. Throws InputError
/// "<name>: line <n>: not valid YAML: ..."
YAML::Node parse_yaml(const std::string& text, const std::string& name);

/// A scalar or a list of numbers. Throws InputError that names `field` for anything else.
FieldValue field_value(const YAML::Node& node, const std::string& field);

/// The value as a file holds it.
std::string to_yaml(const FieldValue& value);

}  // namespace nbvopt
