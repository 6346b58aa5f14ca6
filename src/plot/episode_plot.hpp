// The picture of an episode: the map that it made from above, the robot's way, and where the
// camera looked.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/episode.hpp"

namespace nbvopt {

struct EpisodePlotInput {
  const UncertaintyMap& map;
  const Robot& robot;
  const std::vector<Capture>& captures;  ///< at least one
  std::string subtitle;
};

/// Draws the picture and writes it as PNG, whole or not at all. Throws InputError when the file
/// cannot be written.
void write_episode_plot(const EpisodePlotInput& input, const std::filesystem::path& path);

}  // namespace nbvopt
