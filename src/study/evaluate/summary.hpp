// What sums up numbers, and the runs of each solver within each budget.
#pragma once

#include <cstddef>
#include <vector>

#include "study/evaluate/interval.hpp"
#include "study/results.hpp"

namespace nbvopt::study {

/// NaN of no values.
double mean(const std::vector<double>& values);

/// The value below which a share, in [0, 1], of the sample lies; between two values it is
/// interpolated linearly, so 0.5 gives the median and 0 the least. NaN of no values.
double quantile(std::vector<double> values, double share);

/// Figures are NaN where no run has any.
struct Summary {
  std::size_t solver = 0;
  std::size_t budget = 0;
  std::size_t runs = 0;
  std::size_t failures = 0;
  /// Over the runs of cases with a reference; a failed run counts 0.
  double mean_ratio = 0.0;
  Interval mean_ratio_interval;
  double median_ratio = 0.0;
  double worst_ratio = 0.0;
  /// Over the runs with an answer, with a reference or not.
  double mean_exact_evaluations = 0.0;
  double mean_surrogate_evaluations = 0.0;
  double mean_search_time_ms = 0.0;
  double p99_search_time_ms = 0.0;
};

/// A row for every solver and budget, in this order, whether it has runs or not.
std::vector<Summary> summarise(const Results& results);

}  // namespace nbvopt::study
