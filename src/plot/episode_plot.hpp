// The picture of an episode: the map that it made from above, the robot's way, and where the
// camera looked.
#pragma once

#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/episode.hpp"
#include "sim/episode_output.hpp"

namespace nbvopt {

struct EpisodePlotInput {
  const UncertaintyMap& map;
  const Robot& robot;
  const std::vector<Capture>& captures;  ///< at least one
  const EpisodeReport& report;
};

/// Draws the picture: the bytes of a PNG file.
std::string episode_plot_png(const EpisodePlotInput& input);

/// The map alone with the robot's way and looks, small, to stand beside others.
std::string episode_map_png(const EpisodePlotInput& input);

}  // namespace nbvopt
