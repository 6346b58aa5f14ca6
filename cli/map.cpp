#include "cli/map.hpp"

#include <memory>

#include "cli/map_build.hpp"
#include "cli/map_convert.hpp"
#include "cli/map_input.hpp"
#include "cli/map_insert.hpp"
#include "cli/map_output.hpp"
#include "cli/terminal/output.hpp"
#include "core/stopwatch.hpp"

namespace nbvopt {
namespace {

struct InfoOptions {
  MapInput map;
  bool json = false;
};

void run_info(const InfoOptions& options) {
  const Stopwatch loading;
  const UncertaintyMap map = read_map_input(options.map);
  const double map_load_ms = loading.elapsed_ms();
  if (!options.json) return print_answer(map_text(map));
  Json json{{"map", options.map.file}};
  json.update(map_json(map));
  json["map_load_ms"] = map_load_ms;
  print_answer(to_text(json));
}

void set_up_info(CLI::App& map) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* info = map.add_subcommand("info", "What a map holds");
  add_map_input(*info, "MAP", options->map);
  info->add_flag("--json", options->json, "print one JSON object instead of text");
  info->footer(
      "Voxels are counted at the finest resolution. Information is the sum of 1 - u over occupied\n"
      "voxels (Eq. 11).\n"
      "Example: nbvopt map info map.ot");
  info->callback([options] { run_info(*options); });
}

}  // namespace

void set_up_map(CLI::App& app) {
  CLI::App* map = app.add_subcommand("map", "Look into, convert and build maps");
  map->require_subcommand(1);
  set_up_info(*map);
  set_up_map_convert(*map);
  set_up_map_insert(*map);
  set_up_map_build(*map);
}

}  // namespace nbvopt
