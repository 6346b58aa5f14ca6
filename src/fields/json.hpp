// Fields as JSON.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "nbvopt/fields/field_value.hpp"

namespace nbvopt {

/// The keys and values of an object. Throws InputError "<block> must be an object {...}", or that
/// names "<block>.<key>" for what is no number, string, true or false.
std::vector<FieldSetting> settings_of(const Json& object, const std::string& block);

/// The way back.
Json to_json(std::span<const FieldSetting> settings);

}  // namespace nbvopt
