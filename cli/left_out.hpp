// What a program says that was built without one of its parts.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// Says how to get `what`, such as "nbvopt serve", when `part` is the part's name in CMake's
/// options.
[[noreturn]] inline void refuse_left_out(const std::string& what, const std::string& part) {
  throw UsageError(what + " is not in this build: NBVOPT_BUILD_" + part +
                   " is off (make build builds everything)");
}

/// Adds a subcommand that takes whatever it is given, and refuses.
inline void add_left_out(CLI::App& app, const std::string& name, const std::string& part) {
  CLI::App* command = app.add_subcommand(name, "(not in this build)")->allow_extras();
  command->callback([name, part] { refuse_left_out("nbvopt " + name, part); });
}

}  // namespace nbvopt
