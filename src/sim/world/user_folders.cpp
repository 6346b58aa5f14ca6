#include <cstdlib>
#include <string_view>

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
  const char* value = std::getenv("GAZEBO_MODEL_PATH");
  if (value == nullptr) return paths;
  std::string_view rest = value;
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    if (end != 0) paths.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return paths;
}

}  // namespace nbvopt
