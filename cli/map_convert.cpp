#include "cli/map_convert.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/map_input.hpp"
#include "cli/options/arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/json.hpp"
#include "map/map_format_names.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/floor_plan.hpp"

namespace nbvopt {
namespace {

/// Not a format of whole maps: what ROS navigation reads.
constexpr const char* kFloorPlan = "floor-plan";

struct ConvertOptions {
  MapInput input;
  std::string output_file;
  std::string format;  ///< empty: as the output's extension says
  bool all_points = false;
  std::optional<HeightBand> height_band;
  bool json = false;
};

/// As --format says, or else the extension. Refuses options that this format does not heed.
std::string format_name(const ConvertOptions& options) {
  const std::string extension = std::filesystem::path(options.output_file).extension().string();
  const bool is_floor_plan = options.format.empty() ? extension == ".pgm" || extension == ".yaml"
                                                    : options.format == kFloorPlan;
  std::string name =
      is_floor_plan ? kFloorPlan : to_string(map_format(options.format, options.output_file));
  if (options.height_band && !is_floor_plan) {
    throw UsageError("--height-band is of floor plans (.pgm) only");
  }
  if (options.all_points && name != "ply" && name != "pcd") {
    throw UsageError("--all-points is of points (.ply, .pcd) only");
  }
  return name;
}

void run_convert(const ConvertOptions& options) {
  const std::string format = format_name(options);
  const UncertaintyMap map = read_map_input(options.input);
  if (format == kFloorPlan) {
    write_floor_plan(map, options.output_file, options.height_band.value_or(HeightBand{}));
  } else {
    write_map(map, options.output_file, map_format(format, options.output_file),
              options.all_points ? MapPoints::all : MapPoints::surface);
  }
  if (options.json) {
    print_answer(to_text(
        Json{{"map", options.input.file}, {"out", options.output_file}, {"format", format}}));
  } else {
    print_answer(options.output_file + " (" + format + ") written\n");
  }
}

}  // namespace

void set_up_map_convert(CLI::App& map) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* convert = map.add_subcommand("convert", "Write a map in another format");
  add_map_input(*convert, "IN", options->input);
  convert->add_option("OUT", options->output_file, "the file to write")->required();
  auto formats = enum_names<MapFormat>();
  formats.emplace_back(kFloorPlan);
  convert
      ->add_option("--format", options->format,
                   "uncertainty-ot: all that the map holds; bt: free and occupied only; colour-ot: "
                   "a ColorOcTree for octovis; ply, pcd: points; all three coloured from red "
                   "(uncertain) to green (reliable); floor-plan: .pgm and .yaml for 2D navigation "
                   "in ROS [as OUT's extension says]")
      ->check(CLI::IsMember(formats))
      ->type_name("NAME");
  convert->add_flag("--all-points", options->all_points,
                    "ply, pcd: a point every occupied voxel, not those of surfaces alone");
  convert
      ->add_option_function<std::string>(
          "--height-band",
          [options](const std::string& text) {
            const auto n = numbers_argument("--height-band", text, {2}, "Z0,Z1");
            options->height_band = {.min_m = n[0], .max_m = n[1]};
          },
          "floor-plan: heights in the map, m, without floor and ceiling [all]")
      ->type_name("Z0,Z1");
  convert->add_flag("--json", options->json, "print one JSON object instead of text");
  convert->footer(
      "Example: nbvopt map convert map.bt map.ot\n"
      "         nbvopt map convert map.ot shown.ot --format colour-ot\n"
      "         nbvopt map convert map.ot rooms.pgm --height-band 0.1,1.5\n"
      "         nbvopt map convert data.bin map.bt --message OcTree,0.05,binary");
  convert->callback([options] { run_convert(*options); });
}

}  // namespace nbvopt
