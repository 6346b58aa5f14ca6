// nbvopt study units and record: a study's work for engines that bring workers of their own.
#pragma once

#include <CLI/App.hpp>

namespace nbvopt {

void add_study_exchange(CLI::App& study);

}  // namespace nbvopt
