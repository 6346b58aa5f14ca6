// nbvopt query: where should the camera look next?
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_query(CLI::App& app);

}  // namespace nbvopt
