// nbvopt serve: a planning server for a robot's driver.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_serve(CLI::App& app);

}  // namespace nbvopt
