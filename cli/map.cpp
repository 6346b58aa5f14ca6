#include "cli/map.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "cli/options/arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/number.hpp"
#include "core/stopwatch.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan_file.hpp"
#include "nbvopt/planner/robot.hpp"

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

struct InsertOptions {
  std::string map_file;
  std::string scan_file;
  Transform T_map_sensor = Transform::Identity();
  std::string robot_file;  ///< empty: the paper's platform
  std::optional<DepthImageOptions> depth_image;
  double depth_scale_m = DepthImageOptions{}.depth_scale_m;
  std::string output_file;  ///< empty: MAP itself
  std::optional<double> new_resolution_m;
  bool json = false;
};

constexpr std::array<std::pair<const char*, MapFormat>, 4> kFormats{{
    {"uncertainty-ot", MapFormat::uncertainty_ot},
    {"bt", MapFormat::bt},
    {"colour-ot", MapFormat::colour_ot},
    {"ply", MapFormat::colour_ply},
}};

/// The format of that name, or else of the file's extension.
std::pair<const char*, MapFormat> output_format(const std::string& name, const std::string& file) {
  std::string wanted = name;
  if (wanted.empty()) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension.empty() || extension == ".ot") {
      wanted = "uncertainty-ot";
    } else {
      wanted = extension.substr(1);
    }
  }
  for (const auto& format : kFormats) {
    if (wanted == format.first) return format;
  }
  throw UsageError(file + ": the extension tells no format, end it in .ot, .bt or .ply, or give " +
                   "--format");
}

/// A number for people.
std::string rounded(double value, int digits) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/// The known box in the map frame: its least and its greatest corner.
std::pair<Eigen::Vector3d, Eigen::Vector3d> corners_m(const Lattice& lattice, const KeyBox& box) {
  const Eigen::Vector3d half_voxel_m = Eigen::Vector3d::Constant(lattice.resolution_m() / 2.0);
  return {lattice.centre_m(box.min) - half_voxel_m, lattice.centre_m(box.max) + half_voxel_m};
}

Json point_json(const Eigen::Vector3d& p_map_m) { return {p_map_m.x(), p_map_m.y(), p_map_m.z()}; }

Json map_json(const UncertaintyMap& map) {
  const MapCounts counts = map.counts();
  Json json{{"resolution_m", map.resolution_m()},
            {"occupied_voxels", counts.occupied_voxels},
            {"free_voxels", counts.free_voxels},
            {"certain_voxels", counts.certain_voxels},
            {"information", counts.information},
            {"carries_uncertainty", counts.certain_voxels > 0},
            {"leaves", counts.leaves},
            {"nodes", counts.nodes},
            {"min_m", nullptr},
            {"max_m", nullptr}};
  if (const auto box = map.known_box()) {
    const auto [min_m, max_m] = corners_m(map.lattice(), *box);
    json["min_m"] = point_json(min_m);
    json["max_m"] = point_json(max_m);
  }
  return json;
}

std::string map_text(const UncertaintyMap& map) {
  const MapCounts counts = map.counts();
  std::string text = "resolution         " + format_number(map.resolution_m()) +
                     " m\noccupied voxels    " + std::to_string(counts.occupied_voxels) +
                     "\nfree voxels        " + std::to_string(counts.free_voxels) +
                     "\noccupied with u<1  " + std::to_string(counts.certain_voxels) +
                     "\ninformation        " + rounded(counts.information, 1) +
                     (counts.certain_voxels > 0 ? "" : "  (the map carries no uncertainty)") +
                     "\nleaves, nodes      " + std::to_string(counts.leaves) + ", " +
                     std::to_string(counts.nodes) + "\n";
  if (const auto box = map.known_box()) {
    const auto [min_m, max_m] = corners_m(map.lattice(), *box);
    text += "known box          ";
    for (int axis = 0; axis < 3; ++axis) {
      text += (axis == 0 ? "" : ", ") + rounded(min_m[axis], 2) + " to " + rounded(max_m[axis], 2);
    }
    text += " m\n";
  }
  return text;
}

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
  const auto [name, format] = output_format(options.format, options.output_file);
  const UncertaintyMap map = read_map(options.input_file);
  write_map(map, options.output_file, format);
  if (options.json) {
    print_answer(
        to_text(Json{{"map", options.input_file}, {"out", options.output_file}, {"format", name}}));
  } else {
    print_answer(options.output_file + " (" + name + ") written\n");
  }
}

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
  return read_map(options.map_file);
}

void run_insert(InsertOptions& options) {
  const std::string& output_file =
      options.output_file.empty() ? options.map_file : options.output_file;
  const auto [name, format] = output_format("", output_file);
  require_writable(output_file);
  if (format == MapFormat::bt) {
    print_message("warning: " + output_file + " cannot keep the uncertainty, give --out FILE.ot");
  }
  if (options.depth_image) options.depth_image->depth_scale_m = options.depth_scale_m;
  const Robot robot = options.robot_file.empty() ? Robot{} : read_robot(options.robot_file);
  UncertaintyMap map = map_of(options);
  const Scan scan = read_scan(options.scan_file, options.depth_image);

  const Stopwatch inserting;
  const InsertResult result = insert_scan(map, scan, options.T_map_sensor, robot.sensor);
  const double insert_ms = inserting.elapsed_ms();
  write_map(map, output_file, format);

  if (options.json) {
    Json json{{"map", options.map_file},
              {"out", output_file},
              {"points_used", result.points_used},
              {"rays_cleared", result.rays_cleared},
              {"points_ignored", result.points_ignored},
              {"voxels_changed", result.changes.size()},
              {"insert_ms", insert_ms}};
    json.update(map_json(map));
    print_answer(to_text(json));
  } else {
    print_answer(std::to_string(result.points_used) + " points used, " +
                 std::to_string(result.rays_cleared) + " rays cleared, " +
                 std::to_string(result.points_ignored) + " points ignored, " +
                 std::to_string(result.changes.size()) + " voxels changed\n" + map_text(map));
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
      ->check(CLI::IsMember({"uncertainty-ot", "bt", "colour-ot", "ply"}))
      ->type_name("NAME");
  convert->add_flag("--json", options->json, "print one JSON object instead of text");
  convert->footer(
      "Example: nbvopt map convert map.bt map.ot\n"
      "         nbvopt map convert map.ot shown.ot --format colour-ot");
  convert->callback([options] { run_convert(*options); });
}

void add_scan_arguments(CLI::App& insert, InsertOptions& options) {
  insert.add_option("SCAN", options.scan_file, "a point cloud (PLY or PCD) or a depth image (PNG)")
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
  insert
      .add_option_function<std::string>(
          "--intrinsics",
          [&options](const std::string& text) {
            const auto n = numbers_argument("--intrinsics", text, {4}, "FX,FY,CX,CY");
            options.depth_image = {.fx_px = n[0], .fy_px = n[1], .cx_px = n[2], .cy_px = n[3]};
          },
          "of a depth image, in pixels")
      ->type_name("FX,FY,CX,CY");
  add_number(insert, "--depth-scale", options.depth_scale_m, "M", "metres a unit of a depth image");
}

void set_up_insert(CLI::App& map) {
  auto options = std::make_shared<InsertOptions>();
  CLI::App* insert = map.add_subcommand("insert", "Add a scan to a map");
  insert->add_option("MAP", options->map_file, "a map: .bt or .ot")->required();
  add_scan_arguments(*insert, *options);
  insert
      ->add_option("--robot", options->robot_file,
                   "robot and sensor, a YAML file [the paper's platform]")
      ->type_name("FILE");
  insert->add_option("--out", options->output_file, "the map to write [MAP]")->type_name("FILE");
  add_number(*insert, "--create", options->new_resolution_m, "M",
             "where there is no MAP yet, start an empty one with voxels of this size");
  insert->add_flag("--json", options->json, "print one JSON object instead of text");
  insert->footer(
      "The scan is in the optical frame. Of a depth image, 0 is not known and 65535 nothing in\n"
      "range.\n"
      "Example: nbvopt map insert map.ot scan.ply --pose -1,2,0.4,-0.5,0.5,-0.5,0.5 --create 0.05");
  insert->callback([options] { run_insert(*options); });
}

}  // namespace

void set_up_map(CLI::App& app) {
  CLI::App* map = app.add_subcommand("map", "Look into, convert and build maps");
  map->require_subcommand(1);
  set_up_info(*map);
  set_up_convert(*map);
  set_up_insert(*map);
}

}  // namespace nbvopt
