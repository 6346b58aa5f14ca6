// nbvopt map: what a map holds, other formats of it, and building one from scans.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_map(CLI::App& app);

}  // namespace nbvopt
