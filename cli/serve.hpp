// nbvopt serve: a planning server for a robot's driver.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace nbvopt {

void set_up_serve(CLI::App& app);

/// The versions of all that this program stands on, one a line; the server's libraries among them
/// where it has a server.
std::string tool_versions();

}  // namespace nbvopt
