// All that a report says about a study.
#pragma once

#include <optional>
#include <vector>

#include "study/evaluate/comparison.hpp"
#include "study/evaluate/cycle.hpp"
#include "study/evaluate/dense.hpp"
#include "study/evaluate/modes.hpp"
#include "study/evaluate/profiles.hpp"
#include "study/evaluate/ratio.hpp"
#include "study/evaluate/running_time.hpp"
#include "study/evaluate/summary.hpp"

namespace nbvopt::study {

inline constexpr double kProfileTarget = 0.99;

struct Evaluation {
  std::size_t budget = 0;  ///< the loosest
  std::vector<Summary> summaries;
  std::vector<ExpectedRunningTime> running_times;  ///< to 95, 99 and 99.9 %
  std::vector<SolverProfiles> performance;         ///< to kProfileTarget
  std::vector<SolverProfiles> data;
  std::vector<Cycle> cycles;
  std::vector<BestMotionTime> best_motion_times;
  std::optional<ModeTable> modes;
  std::vector<Comparison> comparisons;
  Excess excess;
  std::vector<DenseSummary> dense;
  double dense_ratio_of_references = 0.0;
};

/// Throws UsageError where the study has no budget.
Evaluation evaluate(const Results& results);

}  // namespace nbvopt::study
