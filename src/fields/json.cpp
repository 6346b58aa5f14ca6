#include "fields/json.hpp"

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

FieldValue field_value(const Json& value, const std::string& field) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  throw InputError(field + " must be a number, a string, true or false");
}

}  // namespace

std::vector<FieldSetting> settings_of(const Json& object, const std::string& block) {
  std::vector<FieldSetting> result;
  for (const auto& [key, value] : object_in(object, block).items()) {
    result.push_back({key, field_value(value, block + "." + key)});
  }
  return result;
}

Json to_json(std::span<const FieldSetting> settings) {
  Json json = Json::object();
  for (const FieldSetting& setting : settings) {
    std::visit([&](const auto& value) { json[setting.key] = value; }, setting.value);
  }
  return json;
}

}  // namespace nbvopt
