// nbvopt view: a map and a plan as a page to walk around in.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_view(CLI::App& app);

}  // namespace nbvopt
