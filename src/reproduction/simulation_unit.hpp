// What one unit of the experiment simulates: a drive that is recorded, or an episode on a drive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "core/json.hpp"
#include "nbvopt/sensor/sensor_options.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/explorer_kind.hpp"

namespace nbvopt {

/// A base pose in the plane of the map.
struct StartPose {
  double x_m;
  double y_m;
  double yaw_rad;
};

/// An exploration.
struct DriveSetting {
  StartPose start;
  double lidar_range_m;   ///< where beams are cropped for the map in the plane
  double duration_max_s;  ///< it ends then
  ExplorerKind explorer = ExplorerKind::plane;
};

/// The camera's mode in one episode, the time t that it may move for and the gain that it seeks.
struct EpisodeSetting {
  std::string mode;  ///< as make_camera_mode() takes it
  double motion_time_s;
  GainKind gain = GainKind::positive;  ///< the paper's

  bool operator==(const EpisodeSetting&) const = default;
};

/// How a name tells a setting's gain, where it is not the paper's: after that separator.
std::string gain_suffix(const EpisodeSetting& setting, char separator);

/// A world as it was when it was read.
struct WorldSource {
  std::filesystem::path file;
  WorldOptions options;
  bool has_people = true;  ///< or they are left out
  std::string digest;      ///< of what is built from it; empty: not read yet
  /// What was read of it, as pack_world() has it, to be read in its place; none: the file itself.
  std::optional<std::filesystem::path> built = {};
};

struct SimulationUnit {
  WorldSource world;
  std::filesystem::path trajectory;    ///< that a drive records and an episode replays
  std::filesystem::path picture = {};  ///< of the map, that an episode draws; empty: none
  std::uint64_t seed = 1;
  std::variant<DriveSetting, EpisodeSetting> setting;
};

Json setting_json(const SimulationUnit& simulation);

/// As its worker gets it.
Json to_json(const SimulationUnit& simulation);

/// The way back. Throws InputError that says what is wrong.
SimulationUnit simulation_unit_of(const Json& json);

/// The command that does the same with `nbvopt simulate`, as a shell would take it; its summary
/// goes to that file.
std::string command_line(const SimulationUnit& simulation, const std::filesystem::path& summary);

/// Reads the world, with or without its people. Throws InputError as nbvopt's read_world() does, or
/// that names the file where it was built and is none of this version's.
World read_world(const WorldSource& source);

/// That of all that a simulation sees of a world.
std::string world_digest(const World& world);

}  // namespace nbvopt
