// How good the answers of a search are.
#pragma once

#include <span>
#include <vector>

#include "bench/search_measurements.hpp"

namespace nbvopt::bench {

/// gain / best_gain; 1 where there is nothing to gain.
double gain_ratio(double gain, double best_gain);

/// Of one search, over queries.
struct SearchQuality {
  double mean_gain_ratio = 0.0;
  double worst_gain_ratio = 0.0;
  double mean_evaluations = 0.0;
  double mean_surrogate_evaluations = 0.0;
  double mean_time_s = 0.0;
};

SearchQuality quality_of(std::span<const SearchAnswer> answers, std::span<const double> best_gains);

}  // namespace nbvopt::bench
