// nbvopt map insert: adds a scan to a map.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

/// `map` is the command that it belongs to.
void set_up_map_insert(CLI::App& map);

}  // namespace nbvopt
