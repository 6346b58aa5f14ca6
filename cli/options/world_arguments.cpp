#include "cli/options/world_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "cli/terminal/output.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

/// Where the user's programs keep what they can make again (XDG Base Directory Specification).
std::optional<fs::path> user_cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return fs::path(cache) / "nbvopt";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return fs::path(home) / ".cache" / "nbvopt";
  }
  return std::nullopt;
}

/// The folders of a colon-separated variable, as Gazebo's own.
void append_paths(const char* variable, std::vector<fs::path>& paths) {
  const char* value = std::getenv(variable);
  if (value == nullptr) return;
  std::string_view rest = value;
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    if (end != 0) paths.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
}

}  // namespace

void add_world_arguments(CLI::App& app, WorldArguments& arguments) {
  app.add_option("WORLD", arguments.world_file,
                 "a Gazebo world (.world, .sdf), or a mesh: .ply, .obj, .stl, .dae")
      ->required();
  app.add_option("--model-path", arguments.model_paths,
                 "a folder of models, after the world's own and before those of GAZEBO_MODEL_PATH; "
                 "may be given several times")
      ->type_name("DIR");
  app.add_option("--geometry", arguments.geometry, "which shapes of the models to take")
      ->check(CLI::IsMember({"visual", "collision"}))
      ->type_name("NAME")
      ->capture_default_str();
  app.add_flag("--strict", arguments.is_strict,
               "refuse a world with parts missing instead of warning");
  CLI::Option* cache =
      app.add_option("--cache", arguments.cache_folder,
                     "where to keep the built world [$XDG_CACHE_HOME/nbvopt or ~/.cache/nbvopt]");
  cache->type_name("DIR");
  app.add_flag("!--no-cache", arguments.is_cached, "build the world anew and keep nothing")
      ->excludes(cache);
}

World read_world(const WorldArguments& arguments) {
  WorldOptions options;
  options.model_paths.assign(arguments.model_paths.begin(), arguments.model_paths.end());
  append_paths("GAZEBO_MODEL_PATH", options.model_paths);
  options.geometry =
      arguments.geometry == "collision" ? WorldGeometry::collision : WorldGeometry::visual;
  options.is_strict = arguments.is_strict;
  if (!arguments.cache_folder.empty()) {
    options.cache_folder = arguments.cache_folder;
  } else if (arguments.is_cached) {
    options.cache_folder = user_cache_folder();
  }
  World world = read_world(fs::path(arguments.world_file), options);
  for (const std::string& warning : world.warnings) print_message("warning: " + warning);
  return world;
}

}  // namespace nbvopt
