// nbvopt map build: makes a map from a recording.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

/// `map` is the command that it belongs to.
void set_up_map_build(CLI::App& map);

}  // namespace nbvopt
