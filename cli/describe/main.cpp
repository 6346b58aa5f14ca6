// Writes what the command line says of itself into a folder: man pages and what shells complete.
//
//     nbvopt_describe FOLDER
#include <cstdio>
#include <exception>
#include <filesystem>

#include "cli/app.hpp"
#include "cli/describe/completion.hpp"
#include "cli/describe/man_page.hpp"
#include "core/atomic_file.hpp"
#include "nbvopt/core/version.hpp"

namespace nbvopt {
namespace {

void describe(const std::filesystem::path& folder) {
  const auto app = make_app();
  std::filesystem::create_directories(folder / "man1");
  for (const Command& command : all_commands(*app)) {
    write_file_atomically(folder / "man1" / (page_name(command) + ".1"),
                          man_page(command, version()));
  }
  write_file_atomically(folder / app->get_name(), bash_completion(*app));
  write_file_atomically(folder / ("_" + app->get_name()), zsh_completion(*app));
}

}  // namespace
}  // namespace nbvopt

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: nbvopt_describe FOLDER\n", stderr);
    return 2;
  }
  try {
    nbvopt::describe(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "nbvopt_describe: %s\n", error.what());
    return 4;
  }
}
