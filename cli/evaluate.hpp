// nbvopt evaluate: what given views are worth.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_evaluate(CLI::App& app);

}  // namespace nbvopt
