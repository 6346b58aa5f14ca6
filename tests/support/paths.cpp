#include "support/paths.hpp"

namespace nbvopt::test {

std::filesystem::path source_dir() { return NBVOPT_SOURCE_DIR; }

std::filesystem::path datasets_dir() { return source_dir() / "datasets"; }

std::filesystem::path shared_dir() { return source_dir().parent_path() / "shared"; }

std::string cli_program() { return NBVOPT_CLI; }

}  // namespace nbvopt::test
