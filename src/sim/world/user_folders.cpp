#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "nbvopt/sim/world.hpp"

namespace nbvopt {

namespace fs = std::filesystem;

std::optional<fs::path> user_cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return fs::path(cache) / "nbvopt";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return fs::path(home) / ".cache" / "nbvopt";
  }
  return std::nullopt;
}

std::vector<fs::path> gazebo_model_paths() {
  std::vector<fs::path> paths;
  std::error_code ignored;
  const auto add = [&](const fs::path& folder) {
    // Set-up scripts name folders that need not be there; Gazebo passes them over, too.
    if (fs::is_directory(folder, ignored) && std::ranges::count(paths, folder) == 0) {
      paths.push_back(folder);
    }
  };
  for (const char* name : {"GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH",
                           "GAZEBO_RESOURCE_PATH"}) {
    const char* value = std::getenv(name);
    std::string_view rest = value == nullptr ? "" : value;
    while (!rest.empty()) {
      const std::size_t end = rest.find(':');
      if (end != 0) add(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    add(fs::path(home) / ".gazebo" / "models");
  }
  return paths;
}

}  // namespace nbvopt
