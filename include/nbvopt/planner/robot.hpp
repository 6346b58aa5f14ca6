// The robot: its camera and its mast, and the file that describes them.
#pragma once

#include <filesystem>
#include <string>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/mast/urdf.hpp"
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
///
/// Or a URDF, told by its content, which gives the mast alone, as read_urdf_mast() has it. Only
/// then may `urdf` name anything.
Robot read_robot(const std::filesystem::path& path, const Robot& defaults = {},
                 const UrdfOptions& urdf = {});

/// The same from text; `name` stands for the file in messages.
Robot parse_robot(const std::string& text, const std::string& name, const Robot& defaults = {},
                  const UrdfOptions& urdf = {});

/// The whole robot as such a YAML file.
std::string to_yaml(const Robot& robot);

}  // namespace nbvopt
