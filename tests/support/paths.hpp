// Where the project's files lie. One source file alone is compiled with these paths, so that the
// others' objects are the same wherever the project was checked out.
#pragma once

#include <filesystem>
#include <string>

namespace nbvopt::test {

std::filesystem::path source_dir();

/// The maps and scenes that ship.
std::filesystem::path datasets_dir();

/// The big maps and known answers beside the project; not everybody has them.
std::filesystem::path shared_dir();

/// The built command line tool.
std::string cli_program();

}  // namespace nbvopt::test
