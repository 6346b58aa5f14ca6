#include "study/evaluate/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "study/evaluate/ratio.hpp"

namespace nbvopt::study {
namespace {

struct Samples {
  std::size_t failures = 0;
  std::size_t runs = 0;
  std::vector<CaseValue> ratio;
  std::vector<double> exact_evaluations;
  std::vector<double> surrogate_evaluations;
  std::vector<double> search_time_ms;

  void add(const Results& results, const Run& run) {
    ++runs;
    if (has_reference(results, run)) {
      ratio.push_back({&results.cases[run.case_index], gain_ratio(results, run)});
    }
    if (run.has_failed()) {
      ++failures;
      return;
    }
    exact_evaluations.push_back(static_cast<double>(run.evaluations));
    surrogate_evaluations.push_back(static_cast<double>(run.surrogate_evaluations));
    search_time_ms.push_back(run.search_time_ms);
  }
};

}  // namespace

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

std::vector<Summary> summarise(const Results& results) {
  const std::size_t budgets = results.budgets.size();
  std::vector<Samples> samples(results.solvers.size() * budgets);
  for (const Run& run : results.runs) {
    samples[run.solver * budgets + run.budget].add(results, run);
  }
  std::vector<Summary> rows;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Samples& own = samples[i];
    const std::vector<double> ratios = values_of(own.ratio);
    rows.push_back({.solver = i / budgets,
                    .budget = i % budgets,
                    .runs = own.runs,
                    .failures = own.failures,
                    .mean_ratio = mean(ratios),
                    .mean_ratio_interval = mean_interval(own.ratio),
                    .median_ratio = quantile(ratios, 0.5),
                    .worst_ratio = quantile(ratios, 0.0),
                    .mean_exact_evaluations = mean(own.exact_evaluations),
                    .mean_surrogate_evaluations = mean(own.surrogate_evaluations),
                    .mean_search_time_ms = mean(own.search_time_ms),
                    .p99_search_time_ms = quantile(own.search_time_ms, 0.99)});
  }
  return rows;
}

}  // namespace nbvopt::study
