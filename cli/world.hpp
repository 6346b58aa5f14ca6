// nbvopt world: what worlds hold.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_world(CLI::App& app);

}  // namespace nbvopt
