// Where the paper's experiment takes place.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reproduction/simulation_unit.hpp"

namespace nbvopt {

/// One of the paper's environments.
struct ExperimentEnvironment {
  std::string_view name;          ///< on command lines and in the names of files
  std::string_view paper_name;    ///< PaperEnvironment::name
  std::string_view world_file;    ///< below the folder of the worlds
  double lidar_range_m;           ///< where beams are cropped for the map in the plane
  double duration_max_s;          ///< explorations in the plane end then
  std::vector<StartPose> starts;  ///< empty: free places, which its world shows
};

/// All of them, in the order of the paper's tables.
std::span<const ExperimentEnvironment> experiment_environments();

/// Those of these names, or all whose worlds are there, in that order. Throws UsageError for a name
/// that is not known, InputError where the world of one that is named, or every world, is not
/// there.
std::vector<const ExperimentEnvironment*> chosen_environments(
    const std::vector<std::string>& names, const std::filesystem::path& worlds_folder);

/// Those that are left out since their worlds are not there; none where environments are named.
std::vector<const ExperimentEnvironment*> missing_environments(
    const std::vector<std::string>& names, const std::filesystem::path& worlds_folder);

/// The environment's starts, or the best free places of its world's main floor, up to three: the
/// same ones each time. Throws InputError as read_world() does, and where there is no room.
std::vector<StartPose> starts_in(const ExperimentEnvironment& environment,
                                 const WorldSource& source);

}  // namespace nbvopt
