// How good answers are by all rays of the camera's image, where the planning image has fewer.
#pragma once

#include <cstddef>
#include <vector>

#include "study/evaluate/interval.hpp"
#include "study/results.hpp"

namespace nbvopt::study {

/// A run's dense gain over the best dense gain of its case that is known, of any run or of the
/// reference's view. Figures are NaN where no run has one.
struct DenseSummary {
  std::size_t solver = 0;
  std::size_t runs = 0;
  double mean_ratio = 0.0;  ///< a failed run counts 0
  Interval mean_interval;
  double worst_ratio = 0.0;
};

/// A row a solver, from the runs with the loosest budget, over the cases whose reference has a
/// dense gain; empty where no case has.
std::vector<DenseSummary> summarise_dense(const Results& results);

/// The same ratio of the references' own views, averaged: what the best view by the planning
/// image's rays is worth by all rays. NaN where no reference has a dense gain.
double dense_ratio_of_references(const Results& results);

}  // namespace nbvopt::study
