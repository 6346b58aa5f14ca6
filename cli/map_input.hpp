// Maps as users name them: files, and what ROS messages carry.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

struct MapInput {
  std::string file;
  std::optional<MapMessage> message = {};  ///< where the file holds a message's data alone
};

/// Adds the map as a positional argument of that name, and --message.
void add_map_input(CLI::App& app, const std::string& name, MapInput& input);

/// Reads the map; what could not be taken as it stands is told on standard error.
UncertaintyMap read_map_input(const MapInput& input);

}  // namespace nbvopt
