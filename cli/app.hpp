// The command line of nbvopt as a whole. Each subcommand has a file pair.
#pragma once

#include <CLI/App.hpp>
#include <memory>

namespace nbvopt {

/// All subcommands, set up to parse.
std::unique_ptr<CLI::App> make_app();

}  // namespace nbvopt
