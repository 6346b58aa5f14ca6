#include "reproduction/paper_experiment.hpp"

#include <algorithm>
#include <iterator>
#include <system_error>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/paper_tables.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

constexpr double kNoHurry_s = 3600.0;  ///< all that is reachable is seen before

std::vector<const ExperimentEnvironment*> chosen_environments(
    const std::vector<std::string>& names) {
  std::string known;
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    known += (known.empty() ? "" : ", ") + std::string(environment.name);
  }
  for (const std::string& name : names) {
    const auto all = experiment_environments();
    if (std::ranges::find(all, name, &ExperimentEnvironment::name) == all.end()) {
      throw UsageError("environment '" + name + "' is none of " + known);
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
  fs::path world = worlds_folder / environment.world_file;
  std::error_code ignored;
  if (!fs::is_regular_file(world, ignored)) {
    throw InputError(world.string() + ": there is no such world; the environment '" +
                     std::string(environment.name) + "' can be left out");
  }
  return world;
}

double duration_max_s(const ExperimentEnvironment& environment, ExplorerKind explorer) {
  if (!ends_with_papers(explorer)) return environment.duration_max_s;
  const auto papers = paper_tables();
  return std::ranges::find(papers, environment.paper_name, &PaperEnvironment::name)
      ->spatial.duration_s;
}

std::string start_name(const Unit& unit) {
  return std::string(unit.environment->name) + '-' + std::to_string(unit.start) + '-';
}

/// What the names of the units of an explorer have before the rest.
std::string explorer_prefix(ExplorerKind explorer) {
  return explorer == ExplorerKind::plane ? "" : std::string(enum_name(explorer)) + '-';
}

Unit drive_unit(const ExperimentOptions& options, const ExperimentEnvironment& environment,
                std::size_t start, ExplorerKind explorer) {
  Unit unit;
  unit.environment = &environment;
  unit.start = start;
  unit.explorer = explorer;
  unit.name = start_name(unit) + explorer_prefix(explorer) + "trajectory";
  const double longest_s = duration_max_s(environment, explorer);
  unit.simulation = {
      .world = {world_of(environment, options.worlds_folder), options.world, {}},
      .trajectory = options.folder.units() / (unit.name + ".csv"),
      .seed = static_cast<std::uint64_t>(options.seed),
      .setting = DriveSetting{
          .start = environment.starts[start - 1],
          .lidar_range_m = environment.lidar_range_m,
          .duration_max_s = std::min(longest_s, options.duration_max_s.value_or(longest_s)),
          .explorer = explorer}};
  return unit;
}

Unit episode_unit(const std::vector<Unit>& units, std::size_t drive,
                  const EpisodeSetting& setting) {
  Unit unit = units[drive];
  unit.name = start_name(unit) + explorer_prefix(unit.explorer) + setting.mode +
              gain_suffix(setting, '-') + '-' + format_number(setting.motion_time_s);
  unit.drive = drive;
  unit.simulation.setting = setting;
  // One picture a camera and environment, all from the same start.
  constexpr double kDrawnMotionTime_s = 0.5;
  if (unit.start == 1 && setting.motion_time_s == kDrawnMotionTime_s) {
    unit.simulation.picture = unit.simulation.trajectory.parent_path() / (unit.name + ".png");
  }
  return unit;
}

template <class Value>
bool is_chosen(const Value& value, const std::vector<Value>& chosen) {
  return chosen.empty() || std::ranges::find(chosen, value) != chosen.end();
}

/// The drives of an explorer from all starts, then what is run on them.
void append_units(std::vector<Unit>& units, const ExperimentOptions& options, ExplorerKind explorer,
                  std::span<const EpisodeSetting> all_settings) {
  std::vector<EpisodeSetting> settings;
  std::ranges::copy_if(all_settings, std::back_inserter(settings),
                       [&](const EpisodeSetting& setting) {
                         return is_chosen(setting.motion_time_s, options.motion_times_s);
                       });
  if (settings.empty()) return;
  const std::size_t first = units.size();
  for (const ExperimentEnvironment* environment : chosen_environments(options.environments)) {
    const auto starts =
        std::min(environment->starts.size(), static_cast<std::size_t>(options.starts));
    for (std::size_t start = 1; start <= starts; ++start) {
      units.push_back(drive_unit(options, *environment, start, explorer));
    }
  }
  const std::size_t end = units.size();
  for (std::size_t drive = first; drive < end; ++drive) {
    for (const EpisodeSetting& setting : settings) {
      units.push_back(episode_unit(units, drive, setting));
    }
  }
}

EpisodeSetting expected(double motion_time_s) {
  return {"auto", motion_time_s, GainKind::expected};
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

std::span<const EpisodeSetting> episode_settings() {
  static const EpisodeSetting kSettings[] = {
      {"static", 0.2}, {"grid", 0.2},   {"auto", 0.2},   expected(0.2), {"oracle", 0.2},  //
      {"static", 0.5}, {"grid", 0.5},   {"grid-3", 0.5}, {"auto", 0.5}, expected(0.5),
      {"random", 0.5}, {"oracle", 0.5},  //
      {"static", 1.0}, {"grid", 1.0},   {"auto", 1.0},   expected(1.0), {"oracle", 1.0},
  };
  return kSettings;
}

std::string test_name(const EpisodeSetting& setting, ExplorerKind explorer) {
  const auto tests = spatial_tests();
  const auto test = std::ranges::find(tests, explorer, &SpatialTest::explorer);
  if (test != tests.end()) return std::string(test->name);
  return setting.mode == "static" ? "2D" : "2D+" + setting.mode + gain_suffix(setting, ' ');
}

std::span<const SpatialTest> spatial_tests() {
  static const SpatialTest kTests[] = {
      {ExplorerKind::volume, "3D", {"static", 0.5}, true},
      {ExplorerKind::volume_tekniker, "3D tekniker", {"static", 0.5}, true},
      {ExplorerKind::volume_after_plane, "3D after 2D", {"static", 0.5}, true},
      {ExplorerKind::views, "NBV", expected(0.5), false},
  };
  return kTests;
}

bool ends_with_papers(ExplorerKind explorer) {
  const auto tests = spatial_tests();
  const auto test = std::ranges::find(tests, explorer, &SpatialTest::explorer);
  return test != tests.end() && test->is_papers;
}

std::vector<Unit> experiment_units(const ExperimentOptions& options) {
  std::vector<Unit> units;
  if (is_chosen(ExplorerKind::plane, options.explorers)) {
    append_units(units, options, ExplorerKind::plane, episode_settings());
  }
  for (const SpatialTest& test : spatial_tests()) {
    if (!is_chosen(test.explorer, options.explorers)) continue;
    append_units(units, options, test.explorer, {&test.setting, 1});
  }
  return units;
}

std::string command_line(const Unit& unit, const ReproductionFolder& folder) {
  return command_line(unit.simulation, folder.units() / (unit.name + ".json"));
}

}  // namespace nbvopt
