// What a run of `nbvopt simulate` says of itself, in the file of its --summary.
#pragma once

#include <filesystem>
#include <string>

#include "nbvopt/sim/prediction_record.hpp"

namespace nbvopt {

struct EpisodeFigures {
  double duration_s = 0.0;
  double voxels = 0.0;
  double information = 0.0;
  double voxels_as_paper_counts = 0.0;
  double information_as_paper_counts = 0.0;
  PredictionRecord prediction;
};

struct ExplorationFigures {
  std::string status;
  double duration_s = 0.0;
  double length_m = 0.0;
};

/// Read a summary. Throw InputError that names the file and the fault when it is missing, torn or
/// without a number that it should hold.
EpisodeFigures read_episode_summary(const std::filesystem::path& path);
ExplorationFigures read_exploration_summary(const std::filesystem::path& path);

}  // namespace nbvopt
