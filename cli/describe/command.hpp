// A command line's own description, as man pages and shells want it.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace nbvopt {

/// An app with its subcommands, theirs and so on.
struct Command {
  const CLI::App* app = nullptr;
  std::string name;  ///< as it is typed, such as "nbvopt map info"
};

/// The app and all commands below it, each before its own; hidden ones are left out.
std::vector<Command> all_commands(const CLI::App& app);

/// The subcommands of one.
std::vector<const CLI::App*> subcommands_of(const CLI::App& app);

/// What an option takes.
struct OptionValue {
  std::string name;                  ///< such as "FILE"; empty: nothing
  std::vector<std::string> choices;  ///< empty: anything
  bool is_path = false;
};
OptionValue value_of(const CLI::Option& option);

/// The names of an option, such as {"-o", "--out"}; none of a positional.
std::vector<std::string> names_of(const CLI::Option& option);

/// The words with `between` in between.
std::string joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace nbvopt
