// The robot: its camera and its mast, and the one file that describes both.
#pragma once

#include <filesystem>
#include <string>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sensor/sensor_options.hpp"

namespace nbvopt {

/// The default is the paper's platform.
struct Robot {
  SensorOptions sensor;
  MastOptions mast;

  bool operator==(const Robot&) const = default;
};

/// Reads a YAML file with the blocks `sensor` and `mast`, whose keys are the fields of the structs
/// above with their units; what is left out is as `defaults` have it. Throws InputError that names
/// file, key and value: an unknown key (with the nearest right one), a wrong type, a value that
/// fails its check.
Robot read_robot(const std::filesystem::path& path, const Robot& defaults = {});

/// The same from text; `name` stands for the file in messages.
Robot parse_robot(const std::string& yaml, const std::string& name, const Robot& defaults = {});

/// The whole robot as such a file.
std::string to_yaml(const Robot& robot);

}  // namespace nbvopt
