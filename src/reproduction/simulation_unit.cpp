#include "reproduction/simulation_unit.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "experiment/digest.hpp"
#include "nbvopt/core/error.hpp"
#include "sensor/sensor_names.hpp"
#include "sim/people/people_json.hpp"
#include "sim/world/built_world.hpp"

namespace nbvopt {
namespace {

Json to_json(const DriveSetting& drive) {
  return {{"start", {drive.start.x_m, drive.start.y_m, drive.start.yaw_rad}},
          {"lidar_range_m", drive.lidar_range_m},
          {"duration_max_s", drive.duration_max_s},
          {"explorer", enum_name(drive.explorer)}};
}

Json to_json(const EpisodeSetting& episode) {
  return {{"mode", episode.mode},
          {"motion_time_s", episode.motion_time_s},
          {"gain", to_string(episode.gain)}};
}

DriveSetting drive_setting_of(const Json& json) {
  const auto start = json.at("start").get<std::array<double, 3>>();
  return {.start = {start[0], start[1], start[2]},
          .lidar_range_m = json.at("lidar_range_m").get<double>(),
          .duration_max_s = json.at("duration_max_s").get<double>(),
          .explorer = enum_value<ExplorerKind>(json.at("explorer").get<std::string>()).value()};
}

EpisodeSetting episode_setting_of(const Json& json) {
  return {.mode = json.at("mode").get<std::string>(),
          .motion_time_s = json.at("motion_time_s").get<double>(),
          .gain = enum_value<GainKind>(json.at("gain").get<std::string>()).value()};
}

Json to_json(const WorldSource& world) {
  Json model_paths = Json::array();
  for (const auto& path : world.options.model_paths) model_paths.push_back(path.string());
  const auto& cache = world.options.cache_folder;
  Json json{{"file", world.file.string()},
            {"people", world.has_people},
            {"digest", world.digest},
            {"model_paths", model_paths},
            {"cache_folder", cache ? Json(cache->string()) : Json(nullptr)}};
  if (world.built) json["built"] = world.built->string();
  return json;
}

WorldSource world_of(const Json& json) {
  WorldSource world;
  world.file = json.at("file").get<std::string>();
  world.has_people = json.at("people").get<bool>();
  world.digest = json.at("digest").get<std::string>();
  for (const Json& path : json.at("model_paths")) {
    world.options.model_paths.emplace_back(path.get<std::string>());
  }
  const Json& cache = json.at("cache_folder");
  if (!cache.is_null()) world.options.cache_folder = cache.get<std::string>();
  if (json.contains("built")) world.built = json.at("built").get<std::string>();
  return world;
}

std::vector<std::string> arguments(const DriveSetting& drive, const std::string& trajectory) {
  const StartPose& start = drive.start;
  return {"--start",
          format_number(start.x_m) + ',' + format_number(start.y_m) + ',' +
              format_number(start.yaw_rad),
          "--explore-only",
          "--trajectory-out",
          trajectory,
          "--lidar-range",
          format_number(drive.lidar_range_m),
          "--duration-max",
          format_number(drive.duration_max_s),
          "--explore",
          std::string(enum_name(drive.explorer))};
}

std::vector<std::string> arguments(const EpisodeSetting& episode, const std::string& trajectory) {
  return {"--trajectory",  trajectory,
          "--mode",        episode.mode,
          "--gain",        to_string(episode.gain),
          "--motion-time", format_number(episode.motion_time_s)};
}

/// A word that a shell takes as it is, in quotes where need be.
std::string quoted(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-+=,.:/@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + '\'';
}

World read_built_world(const std::filesystem::path& file) {
  const std::string bytes = read_text_file(file);
  try {
    return unpack_world(bytes);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

template <class Value>
std::string_view bytes_of(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

}  // namespace

std::string gain_suffix(const EpisodeSetting& setting, char separator) {
  return setting.gain == GainKind::positive ? "" : separator + to_string(setting.gain);
}

Json setting_json(const SimulationUnit& simulation) {
  return std::visit([](const auto& setting) { return to_json(setting); }, simulation.setting);
}

Json to_json(const SimulationUnit& simulation) {
  Json json{{"world", to_json(simulation.world)},
            {"trajectory", simulation.trajectory.string()},
            {"picture", simulation.picture.string()},
            {"seed", simulation.seed}};
  const bool is_drive = std::holds_alternative<DriveSetting>(simulation.setting);
  json[is_drive ? "drive" : "episode"] = setting_json(simulation);
  return json;
}

SimulationUnit simulation_unit_of(const Json& json) {
  try {
    SimulationUnit simulation{.world = world_of(json.at("world")),
                              .trajectory = json.at("trajectory").get<std::string>(),
                              .picture = json.value("picture", ""),
                              .seed = json.at("seed").get<std::uint64_t>(),
                              .setting = {}};
    if (json.contains("drive")) {
      simulation.setting = drive_setting_of(json.at("drive"));
    } else {
      simulation.setting = episode_setting_of(json.at("episode"));
    }
    return simulation;
  } catch (const Json::exception& error) {
    throw InputError(std::string("unit: ") + error.what());
  }
}

std::string command_line(const SimulationUnit& simulation, const std::filesystem::path& summary) {
  std::vector<std::string> words{"nbvopt", "simulate", simulation.world.file.string()};
  const auto own = std::visit(
      [&](const auto& setting) { return arguments(setting, simulation.trajectory.string()); },
      simulation.setting);
  words.insert(words.end(), own.begin(), own.end());
  const std::array<std::string, 7> common{"--seed",       std::to_string(simulation.seed),
                                          "--summary",    summary.string(),
                                          "--threads",    "1",
                                          "--no-progress"};
  words.insert(words.end(), common.begin(), common.end());
  if (!simulation.world.has_people) words.push_back("--without-people");
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

World read_world(const WorldSource& source) {
  World world =
      source.built ? read_built_world(*source.built) : read_world(source.file, source.options);
  if (!source.has_people) world.people = {};
  return world;
}

std::string world_digest(const World& world) {
  const std::string people = world.people.persons.empty() ? "" : to_text(to_json(world.people));
  return experiment::digest(experiment::digest(bytes_of(world.mesh.vertices_m)) +
                            experiment::digest(bytes_of(world.mesh.triangles)) + people);
}

}  // namespace nbvopt
