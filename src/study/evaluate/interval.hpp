// How far a mean could be off, where questions are clustered.
#pragma once

#include <vector>

#include "study/results.hpp"

namespace nbvopt::study {

/// A number with the question that it belongs to, which must outlive it.
struct CaseValue {
  const CaseResult* of = nullptr;
  double value = 0.0;
};

std::vector<double> values_of(const std::vector<CaseValue>& values);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// 95 % confidence interval of the mean by a bootstrap of two stages (Davison and Hinkley,
/// "Bootstrap Methods and their Application", 3.8): maps are drawn with replacement, then, anew for
/// each, its starts, which keep all their cases and seeds. 1,000 draws, the same on every machine;
/// with the same questions the same are drawn for every solver. NaN of no values.
Interval mean_interval(const std::vector<CaseValue>& values);

}  // namespace nbvopt::study
