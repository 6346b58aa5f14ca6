// The experiment's worlds, all of them one small room: seen in seconds.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "reproduction/paper_experiment.hpp"

namespace nbvopt::test {

/// A Gazebo world with a floor and four walls around 0, this long in x, 3 m in y.
inline std::string room_world(double length_m) {
  const auto box = [](const std::string& name, double x_m, double y_m, double z_m,
                      const std::string& size) {
    return "<model name='" + name + "'><static>true</static><pose>" + std::to_string(x_m) + ' ' +
           std::to_string(y_m) + ' ' + std::to_string(z_m) +
           " 0 0 0</pose><link name='link'><visual name='visual'><geometry><box><size>" + size +
           "</size></box></geometry></visual></link></model>";
  };
  const std::string length = std::to_string(length_m);
  return "<?xml version='1.0'?><sdf version='1.6'><world name='room'>" +
         box("floor", 0.0, 0.0, -0.05, length + " 3 0.1") +
         box("south", 0.0, -1.5, 0.5, length + " 0.1 1") +
         box("north", 0.0, 1.5, 0.5, length + " 0.1 1") +
         box("west", -0.5 * length_m, 0.0, 0.5, "0.1 3 1") +
         box("east", 0.5 * length_m, 0.0, 0.5, "0.1 3 1") + "</world></sdf>";
}

/// Writes the worlds below this folder that have starts of their own: all but the bookstore.
inline void write_room_worlds(const std::filesystem::path& folder, double length_m = 3.0) {
  for (const ExperimentEnvironment& environment : experiment_environments()) {
    if (environment.starts.empty()) continue;
    const std::filesystem::path world = folder / environment.world_file;
    std::filesystem::create_directories(world.parent_path());
    std::ofstream(world) << room_world(length_m);
  }
}

}  // namespace nbvopt::test
