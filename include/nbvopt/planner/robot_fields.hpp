// The fields of the robot by name, as files and messages give them: one table for the robot's YAML
// and for the `sensor` block of pose files.
#pragma once

#include <span>
#include <string>

#include "nbvopt/fields/field_value.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// Writes the settings into the options and validates the whole. Throws InputError that names
/// `file`, key and value: an unknown key (with the nearest right one), a key given twice, a wrong
/// type, a value that fails its check.
///
/// A sensor whose `range_axis: z_depth` is set is the released code's: where the settings do not
/// give them, its rays are equal_angles and near_blocking is false.
void set_fields(SensorOptions& sensor, std::span<const FieldSetting> settings,
                const std::string& file);
void set_fields(MastOptions& mast, std::span<const FieldSetting> settings, const std::string& file);

}  // namespace nbvopt
