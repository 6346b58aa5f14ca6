// nbvopt map convert: write a map in another format.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

/// Adds the subcommand to `nbvopt map`.
void set_up_map_convert(CLI::App& map);

}  // namespace nbvopt
