// Every solver against the first one.
#pragma once

#include <cstddef>
#include <vector>

#include "report/signed_rank.hpp"
#include "study/results.hpp"

namespace nbvopt::study {

/// A solver against the control, case by case: differences are its ratio to the reference, averaged
/// over seeds, minus the control's.
struct Comparison {
  std::size_t solver = 0;
  SignedRankTest test;
  double holm_p = 1.0;             ///< corrected for all comparisons; NaN where nothing is shared
  double median_difference = 0.0;  ///< NaN where the two share no case
};

/// A row for every solver but the first, from the runs with the loosest budget, over the cases with
/// a reference in which both have runs.
std::vector<Comparison> compare_with_control(const Results& results);

}  // namespace nbvopt::study
