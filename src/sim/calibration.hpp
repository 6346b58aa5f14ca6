// Learns the hazards of the expected gain from drives, and judges them where they were not learnt.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/sim/episode.hpp"
#include "nbvopt/sim/prediction_record.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"

namespace nbvopt {

/// One drive; those through the same world are left out together.
struct CalibrationDrive {
  std::string world;
  const Scene& scene;
  Trajectory trajectory;
};

/// How well views were foretold in an episode that seeks the expected gain by `auto`.
struct PredictionJudgement {
  PredictionRecord chosen;   ///< of the views that it took
  PredictionRecord random;   ///< of ten random views in reach of each step
  double chosen_gain = 0.0;  ///< realised, summed over the steps
  double best_gain = 0.0;    ///< realised by the best of all views of each step, summed
  double information = 0.0;  ///< of the map

  /// What the best of the views would have realised more, step by step, as a share of it.
  double regret() const { return best_gain > 0.0 ? 1.0 - chosen_gain / best_gain : 0.0; }
};

struct DriveCalibration {
  std::string world;
  HazardTable learnt;                ///< by this drive alone, without any prior
  PredictionJudgement from_nothing;  ///< began with one hit in two metres, the weight of one metre
  PredictionJudgement left_out;      ///< began with what the drives through other worlds taught
};

struct Calibration {
  HazardTable hazards;  ///< what all drives taught, with the weight of two metres a context
  std::vector<DriveCalibration> drives;
};

/// Runs two episodes a drive, with the robot, motion time, start and seed of `options`; its gain
/// and hazards do not count. Without drives through other worlds `left_out` begins with what ships.
/// `progress` is told the share that is done. Throws InputError as run_episode() does.
Calibration calibrate(std::span<const CalibrationDrive> drives, const EpisodeOptions& options,
                      double resolution_m, const std::function<void(double)>& progress);

/// What these tables counted together, with the weight of two metres a context; contexts that none
/// of them met are as HazardTable has them.
HazardTable pooled_prior(std::span<const HazardTable> learnt, double floor_map_m);

}  // namespace nbvopt
