#include "cli/map_insert.hpp"

#include <CLI/Option.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "cli/map_input.hpp"
#include "cli/map_output.hpp"
#include "cli/options/arguments.hpp"
#include "cli/options/depth_image_arguments.hpp"
#include "cli/options/robot_file_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/atomic_file.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan_file.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt {
namespace {

struct InsertOptions {
  std::string map_file;
  std::string scan_file;
  Transform T_map_sensor = Transform::Identity();
  RobotFileArguments robot;
  DepthImageArguments depth_image;
  std::string output_file;  ///< empty: MAP itself
  std::optional<double> new_resolution_m;
  bool is_clear_only = false;   ///< a scan without a point in range is meant as it is
  bool is_overwritten = false;  ///< keep no backup
  bool json = false;
};

/// A path that cannot be looked at counts as there: reading it says why it cannot be read.
bool exists(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(path, error) || error;
}

/// The map to insert into: read, or made where --create says so and there is none.
UncertaintyMap map_of(const InsertOptions& options) {
  if (options.new_resolution_m && !exists(options.map_file)) {
    return UncertaintyMap(*options.new_resolution_m);
  }
  return read_map_input({.file = options.map_file});
}

/// Writes the map; the file that it replaces is kept unless it may be overwritten. The backup, if
/// any.
std::optional<std::string> write(const UncertaintyMap& map, const std::string& file,
                                 MapFormat format, bool is_overwritten) {
  std::error_code ignored;
  if (is_overwritten || !std::filesystem::is_regular_file(file, ignored)) {
    write_map(map, file, format);
    return std::nullopt;
  }
  write_file_with_backup(file, map_file_bytes(map, format));
  return backup_of(file).string();
}

/// Where the points lie that were not used: a line, or nothing where all were.
std::string unused_text(const ScanCounts& counts) {
  std::string text;
  for (const auto& [count, place] : {std::pair{counts.points_too_near, " too near"},
                                     {counts.points_too_far, " too far"},
                                     {counts.no_returns, " without return"},
                                     {counts.points_not_finite, " not finite"},
                                     {counts.points_off_lattice, " off the lattice"}}) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + place;
  }
  return text.empty() ? "" : "not used: " + text + "\n";
}

void require_in_range(const std::string& file, const Scan& scan, const SensorOptions& sensor) {
  const std::string doubt = none_in_range(count_scan(scan, sensor), sensor);
  if (!doubt.empty()) {
    throw InputError(file + ": " + doubt + " (--clear-only inserts it as it is)");
  }
}

void run_insert(InsertOptions& options) {
  const std::string& output_file =
      options.output_file.empty() ? options.map_file : options.output_file;
  const MapFormat format = map_format("", output_file);
  require_writable(output_file);
  if (format == MapFormat::bt) {
    print_message("warning: " + output_file + " cannot keep the uncertainty, give --out FILE.ot");
  }
  const Robot robot = read_robot(options.robot, {});
  UncertaintyMap map = map_of(options);
  const Scan scan = read_scan(options.scan_file, depth_image_options(options.depth_image));
  if (!options.is_clear_only) require_in_range(options.scan_file, scan, robot.sensor);

  const Stopwatch inserting;
  const InsertResult result = insert_scan(map, scan, options.T_map_sensor, robot.sensor);
  const double insert_ms = inserting.elapsed_ms();
  const std::optional<std::string> backup = write(map, output_file, format, options.is_overwritten);

  if (options.json) {
    Json json{{"map", options.map_file},
              {"out", output_file},
              {"points_used", result.points_used},
              {"rays_cleared", result.rays_cleared},
              {"points_ignored", result.points_ignored},
              {"points_too_near", result.points_too_near},
              {"points_too_far", result.points_too_far},
              {"no_returns", result.no_returns},
              {"points_not_finite", result.points_not_finite},
              {"points_off_lattice", result.points_off_lattice},
              {"voxels_changed", result.changes.size()},
              {"backup", backup ? Json(*backup) : Json()},
              {"insert_ms", insert_ms}};
    json.update(map_json(map));
    print_answer(to_text(json));
  } else {
    print_answer(std::to_string(result.points_used) + " points used, " +
                 std::to_string(result.rays_cleared) + " rays cleared, " +
                 std::to_string(result.points_ignored) + " points ignored, " +
                 std::to_string(result.changes.size()) + " voxels changed\n" + unused_text(result) +
                 (backup ? "the file before is kept as " + *backup + "\n" : "") + map_text(map));
  }
}

void add_scan_arguments(CLI::App& insert, InsertOptions& options) {
  insert
      .add_option("SCAN", options.scan_file,
                  "a point cloud (PLY, PCD, XYZ text) or a 16-bit depth image (PNG, PGM)")
      ->required();
  insert
      .add_option_function<std::string>(
          "--pose",
          [&options](const std::string& text) {
            const auto n = numbers_argument("--pose", text, {7}, "X,Y,Z,QX,QY,QZ,QW");
            options.T_map_sensor =
                pose_from_quaternion({n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]});
          },
          "the optical frame in the map (z forward, x right, y down): position and quaternion")
      ->type_name("X,Y,Z,QX,QY,QZ,QW")
      ->required();
  add_depth_image_arguments(insert, options.depth_image, "");
}

}  // namespace

void set_up_map_insert(CLI::App& map) {
  auto options = std::make_shared<InsertOptions>();
  CLI::App* insert = map.add_subcommand("insert", "Add a scan to a map");
  insert->add_option("MAP", options->map_file, "a map: .bt or .ot")->required();
  add_scan_arguments(*insert, *options);
  add_robot_file(*insert, options->robot);
  insert->add_option("--out", options->output_file, "the map to write [MAP]")->type_name("FILE");
  insert->add_flag("--overwrite", options->is_overwritten,
                   "keep no backup of the file that is replaced [it is kept as FILE.bak]");
  insert->add_flag("--clear-only", options->is_clear_only,
                   "take a scan of which no point is in range: it can only clear [refused, since "
                   "its unit or scale is likely wrong]");
  add_number(*insert, "--create", options->new_resolution_m, "M",
             "where there is no MAP yet, start an empty one with voxels of this size");
  insert->add_flag("--json", options->json, "print one JSON object instead of text");
  insert->footer(
      "The scan is in the optical frame. Of a depth image, 0 is not known.\n"
      "Example: nbvopt map insert map.ot scan.ply --pose -1,2,0.4,-0.5,0.5,-0.5,0.5 --create 0.05");
  insert->callback([options] { run_insert(*options); });
}

}  // namespace nbvopt
