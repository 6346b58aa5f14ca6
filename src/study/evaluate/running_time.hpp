// What it costs a search to reach a share of the best gain.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "study/results.hpp"

namespace nbvopt::study {

struct Cost {
  double evaluations = 0.0;  ///< of the exact gain and of the surrogate together
  double time_ms = 0.0;
};

/// What the whole run cost.
Cost whole_cost(const Run& run);

/// What the run had cost when it first held a view with `target` times the best gain of its case:
/// its first progress step that does, or the whole run where only the answer does. None where the
/// answer does not, the run failed, or there is no reference. The answer decides, since it is what
/// the robot gets.
std::optional<Cost> cost_to_reach(const Results& results, const Run& run, double target);

/// The expected running time of COCO (Hansen et al., 2021) when a search is started again until it
/// reaches the target: what all runs spent, until the target or to their end, over the number of
/// those that reached it.
struct ExpectedRunningTime {
  std::size_t solver = 0;
  double target = 0.0;  ///< gain over the best gain
  std::size_t runs = 0;
  std::size_t successes = 0;
  Cost expected;  ///< infinite without success, NaN without runs
};

/// A row for every solver and target, in this order, from the runs with the loosest budget in cases
/// with a reference. Solvers share a tight budget out differently, so its runs are not the
/// beginnings of those with a loose one and are left out.
std::vector<ExpectedRunningTime> expected_running_times(const Results& results,
                                                        const std::vector<double>& targets);

}  // namespace nbvopt::study
