// How near an answer comes to the best there is.
#pragma once

#include <cstddef>

#include "study/results.hpp"

namespace nbvopt::study {

/// The run's gain over the best of its case: 1 where there is none to be had, 0 where the run
/// failed, NaN where the case has no reference. It may exceed 1 a little, since the exact gain is
/// rough and a reference search can miss its last ups: see Excess.
double gain_ratio(const Results& results, const Run& run);

bool has_reference(const Results& results, const Run& run);

/// The budget whose runs are compared in depth. Runs without a time limit do the same each time,
/// so it is the loosest of those, and the longest time limit only where all have one. Throws
/// UsageError where there is no budget.
std::size_t loosest_budget(const Results& results);

/// Answers that are better than their reference.
struct Excess {
  std::size_t runs = 0;
  double greatest_ratio = 1.0;      ///< 1 where there are none
  std::size_t despite_no_gain = 0;  ///< of `runs`: there is gain, but the reference is 0
};

Excess excess_over_reference(const Results& results);

}  // namespace nbvopt::study
