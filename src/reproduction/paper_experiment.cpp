#include "reproduction/paper_experiment.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

constexpr double kNoHurry_s = 3600.0;  ///< all that is reachable is seen before

constexpr EpisodeSetting kSettings[] = {
    {"static", 0.2}, {"grid", 0.2}, {"auto", 0.2},                                    //
    {"static", 0.5}, {"grid", 0.5}, {"grid-3", 0.5}, {"auto", 0.5}, {"random", 0.5},  //
    {"static", 1.0}, {"grid", 1.0}, {"auto", 1.0},
};

std::vector<const ExperimentEnvironment*> chosen_environments(
    const std::vector<std::string>& names) {
  std::string known;
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    known += (known.empty() ? "" : ", ") + std::string(environment.name);
  }
  for (const std::string& name : names) {
    const auto all = experiment_environments();
    if (std::ranges::find(all, name, &ExperimentEnvironment::name) == all.end()) {
      throw UsageError("--environments: '" + name + "' is none of " + known);
    }
  }
  std::vector<const ExperimentEnvironment*> chosen;
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    if (names.empty() || std::ranges::find(names, environment.name) != names.end()) {
      chosen.push_back(&environment);
    }
  }
  return chosen;
}

fs::path world_of(const ExperimentEnvironment& environment, const fs::path& worlds_folder) {
  const fs::path world = worlds_folder / environment.world_file;
  std::error_code ignored;
  if (!fs::is_regular_file(world, ignored)) {
    throw InputError(world.string() + ": there is no such world; --environments can leave out '" +
                     std::string(environment.name) + "'");
  }
  return world;
}

std::string text(const StartPose& start) {
  return format_number(start.x_m) + ',' + format_number(start.y_m) + ',' +
         format_number(start.yaw_rad);
}

/// What both kinds of unit have in common; one thread each, since every core has its own process.
std::vector<std::string> arguments(const ExperimentOptions& options, const Unit& unit,
                                   std::vector<std::string> own) {
  std::vector<std::string> all{
      "simulate",
      world_of(*unit.environment, options.worlds_folder).string(),
  };
  all.insert(all.end(), own.begin(), own.end());
  const std::vector<std::string> common{"--seed",       std::to_string(options.seed),
                                        "--summary",    unit.summary.string(),
                                        "--threads",    "1",
                                        "--no-progress"};
  all.insert(all.end(), common.begin(), common.end());
  return all;
}

Unit exploration_unit(const ExperimentOptions& options, const ExperimentEnvironment& environment,
                      std::size_t start) {
  Unit unit;
  unit.name = std::string(environment.name) + '-' + std::to_string(start) + "-trajectory";
  unit.environment = &environment;
  unit.start = start;
  unit.trajectory = options.output_folder / "units" / (unit.name + ".csv");
  unit.summary = options.output_folder / "units" / (unit.name + ".json");
  std::vector<std::string> own{
      "--start",
      text(environment.starts[start - 1]),
      "--explore-only",
      "--trajectory-out",
      unit.trajectory.string(),
      "--lidar-range",
      format_number(environment.lidar_range_m),
      "--duration-max",
      format_number(std::min(environment.duration_max_s,
                             options.duration_max_s.value_or(environment.duration_max_s)))};
  unit.arguments = arguments(options, unit, own);
  return unit;
}

Unit episode_unit(const ExperimentOptions& options, const Unit& exploration,
                  std::size_t exploration_index, const EpisodeSetting& setting) {
  Unit unit;
  unit.name = std::string(exploration.environment->name) + '-' + std::to_string(exploration.start) +
              '-' + std::string(setting.mode) + '-' + format_number(setting.motion_time_s);
  unit.environment = exploration.environment;
  unit.start = exploration.start;
  unit.episode = setting;
  unit.exploration = exploration_index;
  unit.trajectory = exploration.trajectory;
  unit.summary = options.output_folder / "units" / (unit.name + ".json");
  unit.arguments =
      arguments(options, unit,
                {"--trajectory", unit.trajectory.string(), "--mode", std::string(setting.mode),
                 "--motion-time", format_number(setting.motion_time_s)});
  return unit;
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

}  // namespace

std::span<const ExperimentEnvironment> experiment_environments() {
  static const std::vector<ExperimentEnvironment> kEnvironments{
      {"simple_house",
       "simple house",
       "simple_house/worlds/house_with_door.world",
       4.0,
       kNoHurry_s,
       {{-3.0, 1.0, 0.0}, {5.5, -3.0, 1.57}, {-6.5, -3.0, 0.0}}},
      {"apartment",
       "apartment",
       "apartment/worlds/small_house.world",
       4.0,
       kNoHurry_s,
       {{0.0, 0.0, 0.0}, {-7.0, 0.0, 0.0}, {6.0, -3.0, 3.0}}},
      {"cafe",
       "cafe",
       "cafe/worlds/cafe_static_closed.world",
       4.0,
       kNoHurry_s,
       {{0.0, 0.0, 0.0}, {0.0, 9.0, 0.0}, {1.0, -9.0, 1.57}}},
      {"warehouse",
       "warehouse",
       "warehouse/worlds/small_warehouse.world",
       4.0,
       kNoHurry_s,
       {{0.0, 0.0, 0.0}, {-4.0, 8.0, 0.0}, {4.5, -8.0, 3.0}}},
      {"willowgarage",
       "willowgarage",
       "willowgarage/worlds/willowgarage_closed.world",
       10.0,
       1615.0,  // as long as the paper's: to see it all takes our robot 3,800 s
       {{0.0, 0.0, 0.0}}},
  };
  return kEnvironments;
}

std::span<const EpisodeSetting> episode_settings() { return kSettings; }

std::vector<Unit> experiment_units(const ExperimentOptions& options) {
  std::vector<Unit> units;
  for (const ExperimentEnvironment* environment : chosen_environments(options.environments)) {
    const auto starts =
        std::min(environment->starts.size(), static_cast<std::size_t>(options.starts));
    for (std::size_t start = 1; start <= starts; ++start) {
      units.push_back(exploration_unit(options, *environment, start));
    }
  }
  const std::size_t explorations = units.size();
  for (std::size_t exploration = 0; exploration < explorations; ++exploration) {
    for (const EpisodeSetting& setting : kSettings) {
      units.push_back(episode_unit(options, units[exploration], exploration, setting));
    }
  }
  return units;
}

std::string command_line(const Unit& unit) {
  std::string line = "nbvopt";
  for (const std::string& argument : unit.arguments) line += ' ' + quoted(argument);
  return line;
}

}  // namespace nbvopt
