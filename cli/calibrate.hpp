// nbvopt calibrate: what drives teach of the unknown, and how well that holds elsewhere.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_calibrate(CLI::App& app);

}  // namespace nbvopt
