// nbvopt robot show: what a robot's file says.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_robot(CLI::App& app);

}  // namespace nbvopt
