// The paper's experiment (Section V) as a list of commands: where it takes place, from which
// starts, and what is run there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nbvopt {

/// A base pose in the plane of the map.
struct StartPose {
  double x_m;
  double y_m;
  double yaw_rad;
};

/// One of the paper's environments that can be had.
struct ExperimentEnvironment {
  std::string_view name;        ///< on command lines and in the names of files
  std::string_view paper_name;  ///< PaperEnvironment::name
  std::string_view world_file;  ///< below the folder of the worlds
  double lidar_range_m;         ///< where beams are cropped for the map in the plane
  double duration_max_s;        ///< explorations end then
  std::vector<StartPose> starts;
};

/// All of them, in the order of the paper's tables.
std::span<const ExperimentEnvironment> experiment_environments();

/// The camera's mode in one episode and the time t that it may move for.
struct EpisodeSetting {
  std::string_view mode;  ///< as `nbvopt simulate --mode` takes it
  double motion_time_s;

  bool operator==(const EpisodeSetting&) const = default;
};

/// What is run on every trajectory: the still camera first for each t, which the rest of that t is
/// compared with.
std::span<const EpisodeSetting> episode_settings();

/// What `nbvopt reproduce` is to run.
struct ExperimentOptions {
  std::filesystem::path worlds_folder;
  std::filesystem::path output_folder;
  std::vector<std::string> environments;  ///< by name; empty: all
  std::int64_t starts = 3;                ///< the first so many of each environment
  std::int64_t seed = 1;
  std::optional<double> duration_max_s;  ///< of explorations; none: as the environment has it
};

/// One run of `nbvopt simulate`: an exploration, which records a trajectory, or an episode on it.
struct Unit {
  std::string name;
  const ExperimentEnvironment* environment = nullptr;
  std::size_t start = 0;                  ///< counts from 1
  std::optional<EpisodeSetting> episode;  ///< none: an exploration
  std::size_t exploration = 0;            ///< of an episode: the unit that records its trajectory
  std::vector<std::string> arguments;     ///< of nbvopt
  std::filesystem::path trajectory;       ///< recorded or replayed
  std::filesystem::path summary;          ///< written last
};

/// All units, explorations before the episodes. Throws UsageError for an environment that is not
/// known, InputError for a world that is not there.
std::vector<Unit> experiment_units(const ExperimentOptions& options);

/// The unit's command as a shell would take it.
std::string command_line(const Unit& unit);

}  // namespace nbvopt
