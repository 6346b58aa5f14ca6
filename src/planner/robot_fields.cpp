#include "nbvopt/planner/robot_fields.hpp"

#include <algorithm>

#include "fields/keys.hpp"
#include "nbvopt/core/error.hpp"
#include "planner/robot_field_tables.hpp"

namespace nbvopt {
namespace {

template <class Options>
void set_all(Options& options, std::span<const FieldSetting> settings, const std::string& file) {
  const std::span<const Field<Options>> fields = fields_of(options);
  const std::string block = file + ": " + block_name(options);
  KeyCheck keys(field_keys(fields));
  for (const auto& [key, value] : settings) {
    const std::string name = block + "." + key;
    keys.take(key, block, name);
    set_field(options, *find_field(fields, key), value, name);
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
