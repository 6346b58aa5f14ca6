// What one test learns more than another from the same starts, and whether that may be luck.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "reproduction/record.hpp"

namespace nbvopt {

/// Two tests of one t, over all starts and seeds with which both have run. Percentages are of the
/// other's information (Eq. 11) at the end.
struct PairedComparison {
  std::string test;
  std::string other;
  double motion_time_s = 0.0;
  std::size_t pairs = 0;
  std::size_t better = 0;  ///< of the pairs: those in which the test knows more than the other
  double mean_percent = 0.0;
  double least_percent = 0.0;
  double most_percent = 0.0;
  double p = 1.0;       ///< Wilcoxon's signed-rank test of the percentages, two-sided
  double holm_p = 1.0;  ///< corrected for all comparisons
};

/// What looks by `auto`, in the plane for each gain and t, against every other test of that t; none
/// where no drives have both.
std::vector<PairedComparison> compare_tests(std::span<const Unit> units,
                                            std::span<const UnitResult> results);

}  // namespace nbvopt
