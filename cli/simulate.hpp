// nbvopt simulate: one episode of the paper's experiment in a simulated world.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_simulate(CLI::App& app);

}  // namespace nbvopt
