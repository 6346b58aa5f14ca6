#include "nbvopt/planner/robot_fields.hpp"

#include <algorithm>

#include "core/edit_distance.hpp"
#include "nbvopt/core/error.hpp"
#include "planner/field_table.hpp"
#include "planner/field_value.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

using nbvopt::store;

template <class Enum>
requires std::is_enum_v<Enum> std::string store(const FieldValue& value, Enum& field) {
  const auto* name = std::get_if<std::string>(&value);
  if (const auto known = name ? enum_value<Enum>(*name) : std::nullopt) {
    field = *known;
    return {};
  }
  std::string demand;
  for (const std::string& known : enum_names<Enum>()) {
    demand += (demand.empty() ? "one of " : ", ") + known;
  }
  return demand;
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
