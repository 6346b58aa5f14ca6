// nbvopt study: searches compared on many questions.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void set_up_study(CLI::App& app);

}  // namespace nbvopt
