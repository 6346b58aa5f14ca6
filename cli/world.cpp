#include "cli/world.hpp"

#include <memory>

#include "cli/options/start_place.hpp"
#include "cli/options/world_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/json.hpp"
#include "core/number.hpp"
#include "nbvopt/sim/world_survey.hpp"

namespace nbvopt {
namespace {

struct InfoOptions {
  WorldArguments world;
  bool json = false;
};

Json numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json world_json(const std::string& file, const World& world, const WorldSurvey& survey) {
  Json json{{"world", file},
            {"extent_m", nullptr},
            {"models", world.models},
            {"nested_models", world.nested_models},
            {"triangles", world.mesh.triangles.size()},
            {"floors", Json::array()},
            {"starts", Json::array()},
            {"missing", world.missing},
            {"warnings", world.warnings}};
  if (!world.bounds_m.isEmpty()) {
    json["extent_m"] = {{"min", numbers(world.bounds_m.min())},
                        {"max", numbers(world.bounds_m.max())}};
  }
  for (const FloorLevel& floor : survey.floors) {
    json["floors"].push_back({{"height_m", floor.height_m}, {"area_m2", floor.area_m2}});
  }
  for (const StartPlace& start : survey.starts) {
    json["starts"].push_back({{"pose", pose_of(start)}, {"room_m", start.room_m}});
  }
  return json;
}

std::string extent_text(const Eigen::AlignedBox3d& bounds_m) {
  if (bounds_m.isEmpty()) return "extent: planes only\n";
  std::string ranges;
  std::string sizes;
  for (int axis = 0; axis < 3; ++axis) {
    ranges += std::string(axis == 0 ? "" : ", ") + "xyz"[axis] + " " +
              decimal(bounds_m.min()[axis], 2) + " to " + decimal(bounds_m.max()[axis], 2);
    sizes += (axis == 0 ? "" : " x ") + decimal(bounds_m.sizes()[axis], 2);
  }
  return "extent: " + sizes + " m (" + ranges + "), planes aside\n";
}

std::string world_text(const World& world, const WorldSurvey& survey) {
  std::string text = extent_text(world.bounds_m);
  text += "geometry: " + grouped(static_cast<double>(world.mesh.triangles.size())) +
          " triangles of " + std::to_string(world.models) + " models (and " +
          std::to_string(world.nested_models) + " in them)\n";
  text += "missing: " +
          (world.missing.empty()
               ? std::string("nothing")
               : std::to_string(world.missing.size()) + " parts, as the warnings say") +
          "\n";
  if (survey.floors.empty()) text += "floors: none on which a base could stand\n";
  for (const FloorLevel& floor : survey.floors) {
    text += "floor: z = " + decimal(floor.height_m, 2) + " m, the base can stand on about " +
            decimal(floor.area_m2, 0) + " m2\n";
  }
  if (survey.starts.empty()) text += "starts: nowhere is room for the base\n";
  for (const StartPlace& start : survey.starts) {
    text +=
        "start: " + pose_text(pose_of(start)) + " (" + decimal(start.room_m, 1) + " m of room)\n";
  }
  return text;
}

void run_info(const InfoOptions& options) {
  const World world = read_world(options.world);
  const WorldSurvey survey = survey_world(Scene(world.mesh), world.bounds_m, {});
  print_answer(options.json ? to_text(world_json(options.world.world_file, world, survey))
                            : world_text(world, survey));
}

void set_up_info(CLI::App& world) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* info = world.add_subcommand("info", "What a world holds, and where a base can start");
  add_world_arguments(*info, options->world);
  info->add_flag("--json", options->json, "print one JSON object instead of text");
  info->footer(
      "Start poses are X,Y,Z,YAW as simulate --start takes them: on the lowest roomy floor first, "
      "in\n"
      "the middle of rooms rather than in the open.\n"
      "Example: nbvopt world info datasets/office.world");
  info->callback([options] { run_info(*options); });
}

}  // namespace

void set_up_world(CLI::App& app) {
  CLI::App* world = app.add_subcommand("world", "Look into worlds");
  world->require_subcommand(1);
  set_up_info(*world);
}

}  // namespace nbvopt
