#include "reproduction/paper_experiment.hpp"

#include <algorithm>
#include <iterator>

#include "core/number.hpp"
#include "reproduction/paper_tables.hpp"

namespace nbvopt {
namespace {

constexpr std::string_view kDriveEnding = "trajectory";

/// Ours in space is given a third of the time that the paper's took there, or as long as a drive in
/// the plane.
double duration_max_s(const ExperimentEnvironment& environment, ExplorerKind explorer) {
  if (explorer == ExplorerKind::plane) return environment.duration_max_s;
  const auto papers = paper_tables();
  const double papers_s = std::ranges::find(papers, environment.paper_name, &PaperEnvironment::name)
                              ->spatial.duration_s;
  return ends_with_papers(explorer) ? papers_s
                                    : std::max(environment.duration_max_s, papers_s / 3.0);
}

/// Where drives begin, and by which seed they are made.
struct Departure {
  const ExperimentEnvironment* environment;
  WorldSource world;
  std::size_t start;  ///< counts from 1
  StartPose pose;
  std::uint64_t seed;
};

std::vector<Departure> departures(const ExperimentOptions& options) {
  std::vector<Departure> all;
  for (const ExperimentEnvironment* environment :
       chosen_environments(options.environments, options.worlds_folder)) {
    const WorldSource world{.file = options.worlds_folder / environment->world_file,
                            .options = options.world,
                            .has_people = options.has_people,
                            .digest = {}};
    const std::vector<StartPose> starts = starts_in(*environment, world);
    const auto count = std::min(starts.size(), static_cast<std::size_t>(options.starts));
    for (std::size_t start = 1; start <= count; ++start) {
      for (std::int64_t i = 0; i < options.seeds; ++i) {
        const auto seed = static_cast<std::uint64_t>(options.seed + i);
        all.push_back({environment, world, start, starts[start - 1], seed});
      }
    }
  }
  return all;
}

bool is_first_seed(std::uint64_t seed, const ExperimentOptions& options) {
  return seed == static_cast<std::uint64_t>(options.seed);
}

Unit drive_unit(const ExperimentOptions& options, const Departure& from, ExplorerKind explorer) {
  Unit unit;
  unit.environment = from.environment;
  unit.start = from.start;
  unit.explorer = explorer;
  unit.name = std::string(from.environment->name) + '-' + std::to_string(from.start) + '-';
  if (!is_first_seed(from.seed, options)) unit.name += "seed-" + std::to_string(from.seed) + '-';
  if (explorer != ExplorerKind::plane) unit.name += std::string(enum_name(explorer)) + '-';
  unit.name += kDriveEnding;
  const double longest_s = duration_max_s(*from.environment, explorer);
  unit.simulation = {
      .world = from.world,
      .trajectory = options.folder.units() / (unit.name + ".csv"),
      .seed = from.seed,
      .setting = DriveSetting{
          .start = from.pose,
          .lidar_range_m = from.environment->lidar_range_m,
          .duration_max_s = std::min(longest_s, options.duration_max_s.value_or(longest_s)),
          .explorer = explorer}};
  return unit;
}

Unit episode_unit(const ExperimentOptions& options, const std::vector<Unit>& units,
                  std::size_t drive, const EpisodeSetting& setting) {
  Unit unit = units[drive];
  unit.name.resize(unit.name.size() - kDriveEnding.size());
  unit.name +=
      setting.mode + gain_suffix(setting, '-') + '-' + format_number(setting.motion_time_s);
  unit.drive = drive;
  unit.simulation.setting = setting;
  // One picture a camera and environment, all from the same start.
  constexpr double kDrawnMotionTime_s = 0.5;
  if (unit.start == 1 && is_first_seed(unit.simulation.seed, options) &&
      setting.motion_time_s == kDrawnMotionTime_s) {
    unit.simulation.picture = options.folder.units() / (unit.name + ".png");
  }
  return unit;
}

template <class Value>
bool is_chosen(const Value& value, const std::vector<Value>& chosen) {
  return chosen.empty() || std::ranges::find(chosen, value) != chosen.end();
}

/// The drives of an explorer, then what is run on them; `drives` counts those of all shards.
void append_units(std::vector<Unit>& units, std::size_t& drives, const ExperimentOptions& options,
                  std::span<const Departure> all_departures, ExplorerKind explorer,
                  std::span<const EpisodeSetting> all_settings) {
  if (!is_chosen(explorer, options.explorers)) return;
  std::vector<EpisodeSetting> settings;
  std::ranges::copy_if(all_settings, std::back_inserter(settings),
                       [&](const EpisodeSetting& setting) {
                         return is_chosen(setting.motion_time_s, options.motion_times_s);
                       });
  if (settings.empty()) return;
  const std::size_t first = units.size();
  for (const Departure& from : all_departures) {
    if (options.shard.has(drives++)) units.push_back(drive_unit(options, from, explorer));
  }
  const std::size_t end = units.size();
  for (std::size_t drive = first; drive < end; ++drive) {
    for (const EpisodeSetting& setting : settings) {
      units.push_back(episode_unit(options, units, drive, setting));
    }
  }
}

EpisodeSetting expected(double motion_time_s) {
  return {"auto", motion_time_s, GainKind::expected};
}

}  // namespace

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
  const std::vector<Departure> from = departures(options);
  std::vector<Unit> units;
  std::size_t drives = 0;
  append_units(units, drives, options, from, ExplorerKind::plane, episode_settings());
  for (const SpatialTest& test : spatial_tests()) {
    append_units(units, drives, options, from, test.explorer, {&test.setting, 1});
  }
  return units;
}

std::string command_line(const Unit& unit, const ReproductionFolder& folder) {
  return command_line(unit.simulation, folder.units() / (unit.name + ".json"));
}

}  // namespace nbvopt
