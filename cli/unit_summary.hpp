// What a run of `nbvopt simulate` says of itself, in the file of its --summary.
#pragma once

#include <filesystem>
#include <string>

namespace nbvopt {

/// Gains predicted (x) and realised (y), summed over steps; sums of several episodes add up.
struct PredictionSums {
  double steps = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;

  PredictionSums& operator+=(const PredictionSums& other);
  /// Pearson's; NaN when either gain does not vary.
  double correlation() const;
  /// How much more was predicted than realised, as a share of what was realised.
  double bias() const { return x / y - 1.0; }
};

struct EpisodeSummary {
  double duration_s = 0.0;
  double voxels = 0.0;
  double information = 0.0;
  double voxels_as_paper_counts = 0.0;
  double information_as_paper_counts = 0.0;
  PredictionSums prediction;
};

struct ExplorationSummary {
  std::string status;
  double duration_s = 0.0;
  double length_m = 0.0;
};

/// Read a summary. Throw InputError that names the file and the fault when it is missing, torn or
/// without a number that it should hold.
EpisodeSummary read_episode_summary(const std::filesystem::path& path);
ExplorationSummary read_exploration_summary(const std::filesystem::path& path);

}  // namespace nbvopt
