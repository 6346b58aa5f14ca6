// The options that say which world a simulation runs in.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "nbvopt/sim/world.hpp"

namespace nbvopt {

struct WorldArguments {
  std::string world_file;
  std::vector<std::string> model_paths;
  std::string geometry = "visual";
  bool is_strict = false;
  std::string unit = "m";
  std::string cache_folder;  ///< empty: the user's
  bool is_cached = true;
};

void add_world_arguments(CLI::App& app, WorldArguments& arguments);

/// Those of them that say how worlds are read, for a command that reads several.
void add_world_reading_arguments(CLI::App& app, WorldArguments& arguments);

/// Reads the world and prints its warnings.
World read_world(const WorldArguments& arguments);

}  // namespace nbvopt
