// The reproduction's results beside the paper's.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reproduction/paired_comparison.hpp"
#include "reproduction/paper_tables.hpp"
#include "reproduction/record.hpp"

namespace nbvopt {

/// Which test of which environment a row is about.
struct RowLabel {
  std::string environment;
  std::string test;  ///< as test_name()
  std::optional<double> motion_time_s;
};

/// Our figures are means over the drives, one a start and seed; percentages and gain compare with
/// the still camera of the same t, over those drives that have both.
struct ResultRow : RowLabel {
  std::string remark;  ///< why there are no figures of ours, if so
  std::optional<double> drives;
  std::optional<double> voxels;
  std::optional<double> voxels_percent;
  std::optional<double> information;
  std::optional<double> information_least;  ///< of the drives
  std::optional<double> information_most;
  std::optional<double> ghosts;  ///< where people walk
  std::optional<double> gain;
  std::optional<double> gain_percent;
  /// The same, each drive only for as long as the paper's test took, if it lasts so long.
  std::optional<double> gain_percent_in_papers_time;
  std::optional<double> mean_information;  ///< over the drive
  /// Until the map knew that share of what the best of all episodes on this drive knew at its end;
  /// none where a start never came so far.
  std::optional<double> time_to_50_percent_s;
  std::optional<double> time_to_80_percent_s;
  std::optional<double> time_to_90_percent_s;
  std::optional<double> regret_percent;  ///< against the oracle of the same t, over shared drives
  std::optional<double> duration_s;
  std::optional<double> voxels_per_s;
  std::optional<double> information_per_s;
  std::optional<double> as_paper_counts_voxels_percent;
  std::optional<double> as_paper_counts_gain_percent;
  const PaperFigures* paper = nullptr;  ///< none: the paper has no such test
};

/// Gain predicted and realised, pooled over the drives in one environment or over all.
struct PredictionRow : RowLabel {
  PredictionRecord record;
};

struct ReproductionTable {
  std::vector<ResultRow> results;
  std::vector<PairedComparison> comparisons;
  std::vector<PredictionRow> predictions;
  std::vector<std::string> missing = {};  ///< names of units without a result
  std::vector<std::string> incomplete =
      {};  ///< names of explorations that ended by their time limit
};

/// The table of these units, whose results stand in their order. Of environments that are not among
/// them, those that are missing have the paper's figures only, and the others no rows.
ReproductionTable make_table(std::span<const Unit> units, std::span<const UnitResult> results,
                             std::span<const ExperimentEnvironment* const> missing = {});

}  // namespace nbvopt
