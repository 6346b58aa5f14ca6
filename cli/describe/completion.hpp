// What shells complete.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace nbvopt {

/// A script for bash (4.3 or newer, nothing else): subcommands, options, the values of options that
/// take one of a few, and files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, with descriptions.
std::string zsh_completion(const CLI::App& app);

}  // namespace nbvopt
