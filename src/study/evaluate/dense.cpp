#include "study/evaluate/dense.hpp"

#include <algorithm>
#include <cmath>

#include "study/evaluate/ratio.hpp"
#include "study/evaluate/summary.hpp"

namespace nbvopt::study {
namespace {

/// The best dense gain of each case; NaN where its reference has none.
std::vector<double> best_dense_gains(const Results& results) {
  std::vector<double> best;
  for (const CaseResult& one : results.cases) best.push_back(one.dense_gain);
  for (const Run& run : results.runs) {
    double& known = best[run.case_index];
    if (run.dense_gain > known) known = run.dense_gain;  // not where one of them is NaN
  }
  return best;
}

double share(double gain, double best) { return best > 0.0 ? gain / best : 1.0; }

}  // namespace

std::vector<DenseSummary> summarise_dense(const Results& results) {
  const std::vector<double> best = best_dense_gains(results);
  if (std::ranges::all_of(best, [](double gain) { return std::isnan(gain); })) return {};
  const std::size_t budget = loosest_budget(results);
  std::vector<std::vector<CaseValue>> ratios(results.solvers.size());
  for (const Run& run : results.runs) {
    const double of = best[run.case_index];
    if (run.budget != budget || std::isnan(of)) continue;
    const double ratio = run.has_failed() ? 0.0 : share(run.dense_gain, of);
    if (std::isnan(ratio)) continue;  // an older record
    ratios[run.solver].push_back({&results.cases[run.case_index], ratio});
  }
  std::vector<DenseSummary> rows;
  for (std::size_t solver = 0; solver < ratios.size(); ++solver) {
    const std::vector<double> values = values_of(ratios[solver]);
    rows.push_back({.solver = solver,
                    .runs = values.size(),
                    .mean_ratio = mean(values),
                    .mean_interval = mean_interval(ratios[solver]),
                    .worst_ratio = quantile(values, 0.0)});
  }
  return rows;
}

double dense_ratio_of_references(const Results& results) {
  const std::vector<double> best = best_dense_gains(results);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (!std::isnan(best[i])) ratios.push_back(share(results.cases[i].dense_gain, best[i]));
  }
  return mean(ratios);
}

}  // namespace nbvopt::study
