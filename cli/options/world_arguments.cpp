#include "cli/options/world_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <map>
#include <utility>

#include "cli/terminal/output.hpp"
#include "sim/world/world_names.hpp"

namespace nbvopt {

namespace {

const std::map<std::string, double> kUnits_m{
    {"mm", 0.001}, {"cm", 0.01}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}};

}  // namespace

void add_world_arguments(CLI::App& app, WorldArguments& arguments) {
  app.add_option("WORLD", arguments.world_file,
                 "a Gazebo world (.world, .sdf), or a mesh: .ply, .obj, .stl, .dae, .off, .gltf, "
                 ".glb (z up; of the last two, y up)")
      ->required();
  add_world_reading_arguments(app, arguments);
}

void add_world_reading_arguments(CLI::App& app, WorldArguments& arguments) {
  app.add_option(
         "--model-path", arguments.model_paths,
         "a folder of models, after the world's own and before those of Gazebo's environment; "
         "may be given several times")
      ->type_name("DIR");
  app.add_option("--geometry", arguments.geometry, "which shapes of the models to take")
      ->check(CLI::IsMember(enum_names<WorldGeometry>()))
      ->type_name("NAME")
      ->capture_default_str();
  app.add_flag("--strict", arguments.is_strict,
               "refuse a world with parts missing instead of warning");
  app.add_option("--unit", arguments.unit, "of the coordinates of a mesh")
      ->check(CLI::IsMember(kUnits_m))
      ->type_name("NAME")
      ->capture_default_str();
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
  for (std::filesystem::path& path : gazebo_model_paths()) {
    options.model_paths.push_back(std::move(path));
  }
  options.geometry = enum_value<WorldGeometry>(arguments.geometry).value();
  options.is_strict = arguments.is_strict;
  options.mesh_unit_m = kUnits_m.at(arguments.unit);
  if (!arguments.cache_folder.empty()) {
    options.cache_folder = arguments.cache_folder;
  } else if (arguments.is_cached) {
    options.cache_folder = user_cache_folder();
  }
  World world = read_world(std::filesystem::path(arguments.world_file), options);
  for (const std::string& warning : world.warnings) print_message("warning: " + warning);
  return world;
}

}  // namespace nbvopt
