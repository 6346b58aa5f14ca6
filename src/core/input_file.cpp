#include "core/input_file.hpp"

#include <cerrno>
#include <system_error>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

std::ifstream open_input_file(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(path.string() + ": " + what);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("is a folder, a file was expected");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse("cannot be opened: " + std::generic_category().message(errno));
  if (in.peek() == std::ifstream::traits_type::eof()) refuse("the file is empty");
  return in;
}

}  // namespace nbvopt
