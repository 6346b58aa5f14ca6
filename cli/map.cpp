#include "cli/map.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <memory>

#include "cli/map_build.hpp"
#include "cli/map_insert.hpp"
#include "cli/map_output.hpp"
#include "cli/terminal/output.hpp"
#include "core/stopwatch.hpp"
#include "map/map_format_names.hpp"

namespace nbvopt {
namespace {

struct InfoOptions {
  std::string map_file;
  bool json = false;
};

struct ConvertOptions {
  std::string input_file;
  std::string output_file;
  std::string format;  ///< empty: as the output's extension says
  bool json = false;
};

void run_info(const InfoOptions& options) {
  const Stopwatch loading;
  const UncertaintyMap map = read_map(options.map_file);
  const double map_load_ms = loading.elapsed_ms();
  if (!options.json) return print_answer(map_text(map));
  Json json{{"map", options.map_file}};
  json.update(map_json(map));
  json["map_load_ms"] = map_load_ms;
  print_answer(to_text(json));
}

void run_convert(const ConvertOptions& options) {
  const MapFormat format = map_format(options.format, options.output_file);
  const UncertaintyMap map = read_map(options.input_file);
  write_map(map, options.output_file, format);
  if (options.json) {
    print_answer(to_text(Json{
        {"map", options.input_file}, {"out", options.output_file}, {"format", to_string(format)}}));
  } else {
    print_answer(options.output_file + " (" + to_string(format) + ") written\n");
  }
}

void set_up_info(CLI::App& map) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* info = map.add_subcommand("info", "What a map holds");
  info->add_option("MAP", options->map_file, "a map: .bt or .ot")->required();
  info->add_flag("--json", options->json, "print one JSON object instead of text");
  info->footer(
      "Voxels are counted at the finest resolution. Information is the sum of 1 - u over occupied\n"
      "voxels (Eq. 11).\n"
      "Example: nbvopt map info map.ot");
  info->callback([options] { run_info(*options); });
}

void set_up_convert(CLI::App& map) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* convert = map.add_subcommand("convert", "Write a map in another format");
  convert->add_option("IN", options->input_file, "a map: .bt or .ot")->required();
  convert->add_option("OUT", options->output_file, "the file to write")->required();
  convert
      ->add_option("--format", options->format,
                   "uncertainty-ot: all that the map holds; bt: free and occupied only; colour-ot: "
                   "a ColorOcTree for octovis; ply: points; both coloured from red (uncertain) to "
                   "green (reliable) [as OUT's extension says]")
      ->check(CLI::IsMember(enum_names<MapFormat>()))
      ->type_name("NAME");
  convert->add_flag("--json", options->json, "print one JSON object instead of text");
  convert->footer(
      "Example: nbvopt map convert map.bt map.ot\n"
      "         nbvopt map convert map.ot shown.ot --format colour-ot");
  convert->callback([options] { run_convert(*options); });
}

}  // namespace

void set_up_map(CLI::App& app) {
  CLI::App* map = app.add_subcommand("map", "Look into, convert and build maps");
  map->require_subcommand(1);
  set_up_info(*map);
  set_up_convert(*map);
  set_up_map_insert(*map);
  set_up_map_build(*map);
}

}  // namespace nbvopt
