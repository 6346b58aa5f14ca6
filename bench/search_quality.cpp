#include "bench/search_quality.hpp"

#include <algorithm>
#include <limits>

namespace nbvopt::bench {

double gain_ratio(double gain, double best_gain) {
  return best_gain > 0.0 ? gain / best_gain : 1.0;
}

SearchQuality quality_of(std::span<const SearchAnswer> answers,
                         std::span<const double> best_gains) {
  SearchQuality quality{.worst_gain_ratio = std::numeric_limits<double>::infinity()};
  const double share = 1.0 / static_cast<double>(answers.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const SearchAnswer& answer = answers[i];
    const double ratio = gain_ratio(answer.gain, best_gains[i]);
    quality.mean_gain_ratio += share * ratio;
    quality.worst_gain_ratio = std::min(quality.worst_gain_ratio, ratio);
    quality.mean_evaluations += share * static_cast<double>(answer.evaluations);
    quality.mean_surrogate_evaluations += share * static_cast<double>(answer.surrogate_evaluations);
    quality.mean_time_s += share * answer.time_s;
  }
  return quality;
}

}  // namespace nbvopt::bench
