// A worker of the reproduction that simulates nothing: it notes what it is asked in a file and
// answers figures of mode and t at once. It misbehaves where its arguments say so.
//
//   odd_simulator CALLS [UNIT DEED]...    UNIT: drive, drive-3d, or mode-t such as auto-0.5
//
// Deeds: throw, abort, die-once, interrupt-once (its coordinator).
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "core/number.hpp"
#include "experiment/digest.hpp"
#include "experiment/worker.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "reproduction/simulation_unit.hpp"
#include "sim/episode_output.hpp"

namespace nbvopt {
namespace {

std::string name_of(const SimulationUnit& simulation) {
  if (const auto* drive = std::get_if<DriveSetting>(&simulation.setting)) {
    if (drive->explorer == ExplorerKind::plane) return "drive";
    return "drive-" + std::string(enum_name(drive->explorer));
  }
  const auto* episode = std::get_if<EpisodeSetting>(&simulation.setting);
  return episode->mode + gain_suffix(*episode, '-') + '-' + format_number(episode->motion_time_s);
}

/// True the first time.
bool is_first(const std::string& mark) {
  if (std::filesystem::exists(mark)) return false;
  std::ofstream(mark) << "done";
  return true;
}

void misbehave(const std::string& deed, const std::string& mark) {
  if (deed == "throw") throw std::runtime_error("no room");
  if (deed == "abort") std::abort();
  if (deed == "die-once" && is_first(mark)) std::raise(SIGKILL);
  if (deed == "interrupt-once" && is_first(mark)) ::kill(::getppid(), SIGINT);
}

Json answer(const SimulationUnit& simulation) {
  Json json;
  if (const auto* drive = std::get_if<DriveSetting>(&simulation.setting)) {
    write_trajectory(Trajectory({{.time_s = 0.0}, {.time_s = drive->duration_max_s}}),
                     simulation.trajectory);
    json = to_json(DriveReport{.duration_s = drive->duration_max_s, .seed = simulation.seed});
  } else {
    const auto& episode = std::get<EpisodeSetting>(simulation.setting);
    EpisodeReport record;
    record.mode = episode.mode;
    record.summary = {.duration_s = 100.0,
                      .voxels = 2000,
                      .information = 1000.0 + 100.0 * static_cast<double>(episode.mode.size()),
                      .prediction = {2, 3, 4, 5, 10, 7}};
    json = to_json(record);
  }
  json["trajectory_digest"] = experiment::file_digest(simulation.trajectory);
  return json;
}

}  // namespace
}  // namespace nbvopt

int main(int argc, char** argv) {
  using namespace nbvopt;
  const std::string calls = argv[1];
  std::map<std::string, std::string> deeds;
  for (int i = 2; i + 1 < argc; i += 2) deeds[argv[i]] = argv[i + 1];
  experiment::run_worker([&](const Json& unit) {
    const SimulationUnit simulation = simulation_unit_of(unit);
    const std::string name = name_of(simulation);
    std::ofstream(calls, std::ios::app) << name + '\n' << std::flush;
    if (deeds.contains(name)) misbehave(deeds.at(name), calls + '-' + name);
    return answer(simulation);
  });
}
