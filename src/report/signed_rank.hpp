// Wilcoxon's signed-rank test, and Holm's correction for making many.
#pragma once

#include <cstddef>
#include <vector>

namespace nbvopt {

struct SignedRankTest {
  std::size_t pairs = 0;  ///< with a difference
  std::size_t zeros = 0;  ///< pairs without one, dropped as Wilcoxon did
  double rank_sum_above = 0.0;
  double rank_sum_below = 0.0;
  bool is_exact = false;  ///< else by the normal approximation
  double p = 1.0;         ///< two-sided; 1 where no pair differs
  /// The matched-pairs rank-biserial correlation: 1 where all differences are positive, -1 where
  /// all are negative, 0 where they balance or there are none.
  double rank_biserial = 0.0;
};

/// Whether differences of pairs are symmetric about 0. Differences up to 1e-9 are none, and those
/// whose sizes differ by no more share their ranks: numerical noise. Up to 50 pairs the
/// distribution is exact; else the normal approximation, corrected for ties, not for
/// continuity.
SignedRankTest signed_rank_test(const std::vector<double>& differences);

/// Holm's step-down correction (1979): p values that hold for all tests together, in the order of
/// the given. NaN is no test and stays NaN.
std::vector<double> holm(const std::vector<double>& p);

}  // namespace nbvopt
