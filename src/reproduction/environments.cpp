#include "reproduction/environments.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/world_survey.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

constexpr double kNoHurry_s = 3600.0;  ///< all that is reachable is seen before

void require_known(const std::vector<std::string>& names) {
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
}

bool has_world(const ExperimentEnvironment& environment, const fs::path& worlds_folder) {
  std::error_code ignored;
  return fs::is_regular_file(worlds_folder / environment.world_file, ignored);
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
      {"bookstore", "bookstore", "bookstore/worlds/bookstore.world", 4.0, kNoHurry_s, {}},
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
       {{0.0, 0.0, 0.0}, {22.5, -13.8, 3.14}, {-13.5, 4.0, 1.57}}},
  };
  return kEnvironments;
}

std::vector<const ExperimentEnvironment*> chosen_environments(const std::vector<std::string>& names,
                                                              const fs::path& worlds_folder) {
  require_known(names);
  std::vector<const ExperimentEnvironment*> chosen;
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    const bool is_named = std::ranges::find(names, environment.name) != names.end();
    if (!is_named && !names.empty()) continue;
    if (has_world(environment, worlds_folder)) {
      chosen.push_back(&environment);
    } else if (is_named) {
      throw InputError((worlds_folder / environment.world_file).string() +
                       ": there is no such world; the environment '" +
                       std::string(environment.name) + "' can be left out");
    }
  }
  if (!chosen.empty()) return chosen;
  throw InputError(worlds_folder.string() + ": none of the worlds is there, such as " +
                   std::string(experiment_environments().front().world_file));
}

std::vector<const ExperimentEnvironment*> missing_environments(
    const std::vector<std::string>& names, const fs::path& worlds_folder) {
  std::vector<const ExperimentEnvironment*> missing;
  if (!names.empty()) return missing;
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    if (!has_world(environment, worlds_folder)) missing.push_back(&environment);
  }
  return missing;
}

std::vector<StartPose> starts_in(const ExperimentEnvironment& environment,
                                 const WorldSource& source) {
  if (!environment.starts.empty()) return environment.starts;
  constexpr std::size_t kStarts = 3;
  constexpr double kFloorHeight_m = 0.15;  // floors are not that uneven
  const World world = read_world(source);
  const WorldSurvey survey = survey_world(Scene(world.mesh), world.bounds_m, {});
  std::vector<StartPose> starts;
  for (const StartPlace& place : survey.starts) {
    const Eigen::Vector3d& position_m = place.position_map_m;
    const double above_m = position_m.z() - survey.starts.front().position_map_m.z();
    if (starts.size() == kStarts || std::abs(above_m) > kFloorHeight_m) break;
    starts.push_back({position_m.x(), position_m.y(), 0.0});
  }
  if (!starts.empty()) return starts;
  throw InputError(source.file.string() + ": a base has no room in it to start from");
}

}  // namespace nbvopt
