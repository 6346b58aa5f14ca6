#include "core/folder.hpp"

#include <system_error>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be created: " + error.message());
}

}  // namespace nbvopt
