// The simulator's part of the Python module.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "nbvopt/map/shared_map.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/scene.hpp"
#include "python/arrays.hpp"
#include "sim/simulation.hpp"

namespace nbvopt::python {

/// A world that was read, ready for casting.
struct ReadyWorld {
  std::string name;
  Eigen::AlignedBox3d bounds_m;
  People people;
  Scene scene;
};

using SharedWorld = std::shared_ptr<ReadyWorld>;

/// An episode that is over.
struct Episode {
  Drive drive;
  Robot robot;
  std::vector<Capture> captures;
  EpisodeReport report;
  std::shared_ptr<SharedMap> map;  ///< with Python
};

/// A world by its file, or one that was read already.
using WorldArgument = std::variant<SharedWorld, std::filesystem::path>;

std::string name_of(const WorldArgument& world);

/// Reads a file as World(path) does.
SharedWorld world_from(const WorldArgument& world);

void bind_world(py::module_& module);
void bind_episode(py::module_& module);
void bind_simulate(py::module_& module);

}  // namespace nbvopt::python
