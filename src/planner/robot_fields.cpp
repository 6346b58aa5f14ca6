#include "nbvopt/planner/robot_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "planner/edit_distance.hpp"
#include "planner/field_table.hpp"

namespace nbvopt {
namespace {

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

// store() writes the value into the field; where it cannot, it says what the value must be.

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

std::string store(const FieldValue& value, int& field) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr || *number != std::floor(*number) ||
      std::abs(*number) > std::numeric_limits<int>::max()) {
    return "a whole number";
  }
  field = static_cast<int>(*number);
  return {};
}

std::string store(const FieldValue& value, Eigen::Vector3d& field) {
  const auto* list = std::get_if<std::vector<double>>(&value);
  if (list == nullptr || list->size() != 3) return "a list of three numbers";
  field << (*list)[0], (*list)[1], (*list)[2];
  return {};
}

template <class Enum>
requires std::is_enum_v<Enum> std::string store(const FieldValue& value, Enum& field) {
  const auto* name = std::get_if<std::string>(&value);
  std::string known;
  for (const Enum enumerator : kEnumerators<Enum>) {
    if (name != nullptr && *name == to_string(enumerator)) {
      field = enumerator;
      return {};
    }
    known += (known.empty() ? "one of " : ", ") + to_string(enumerator);
  }
  return known;
}

template <class Options>
void set_field(Options& options, const FieldSetting& setting, const std::string& block) {
  std::vector<std::string> keys;
  bool found = false;
  std::string demand;
  for_each_field(options, [&](const char* key, auto& field, const char*) {
    keys.emplace_back(key);
    if (setting.key != key) return;
    found = true;
    demand = store(setting.value, field);
  });
  if (!found) {
    throw InputError(block + ": unknown key '" + setting.key + "', did you mean '" +
                     nearest_word(setting.key, keys) + "'?");
  }
  if (!demand.empty()) {
    throw InputError(block + "." + setting.key + " is " + to_text(setting.value) + ", it must be " +
                     demand);
  }
}

template <class Options>
void set_all(Options& options, std::span<const FieldSetting> settings, const std::string& file) {
  const std::string block = file + ": " + block_name(options);
  for (auto setting = settings.begin(); setting != settings.end(); ++setting) {
    if (std::any_of(settings.begin(), setting,
                    [&](const FieldSetting& earlier) { return earlier.key == setting->key; })) {
      throw InputError(block + "." + setting->key + " is given twice, keep one");
    }
    set_field(options, *setting, block);
  }
  try {
    options.validate();
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
}

}  // namespace

void set_fields(SensorOptions& sensor, std::span<const FieldSetting> settings,
                const std::string& file) {
  const auto gives = [&](const char* key) {
    return std::any_of(settings.begin(), settings.end(),
                       [key](const FieldSetting& setting) { return setting.key == key; });
  };
  set_all(sensor, settings, file);
  if (gives("range_axis") && sensor.range_axis == RangeAxis::z_depth) {
    if (!gives("ray_pattern")) sensor.ray_pattern = RayPattern::equal_angles;
    if (!gives("near_blocking")) sensor.near_blocking = false;
  }
}

void set_fields(MastOptions& mast, std::span<const FieldSetting> settings,
                const std::string& file) {
  set_all(mast, settings, file);
}

}  // namespace nbvopt
