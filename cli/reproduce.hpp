// nbvopt reproduce: the paper's experiment, with one table at its end.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_reproduce(CLI::App& app);

}  // namespace nbvopt
