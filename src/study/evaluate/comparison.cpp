#include "study/evaluate/comparison.hpp"

#include <cmath>
#include <limits>

#include "study/evaluate/ratio.hpp"
#include "study/evaluate/summary.hpp"

namespace nbvopt::study {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// [solver][case]: the mean ratio over seeds, NaN where there is none.
std::vector<std::vector<double>> mean_ratios(const Results& results) {
  struct Sum {
    double ratios = 0.0;
    std::size_t runs = 0;
  };
  std::vector<std::vector<Sum>> sums(results.solvers.size(),
                                     std::vector<Sum>(results.cases.size()));
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.budget != budget) continue;
    Sum& sum = sums[run.solver][run.case_index];
    sum.ratios += gain_ratio(results, run);
    ++sum.runs;
  }
  std::vector<std::vector<double>> means;
  for (const std::vector<Sum>& of_solver : sums) {
    means.emplace_back();
    for (const Sum& sum : of_solver) {
      means.back().push_back(sum.ratios / static_cast<double>(sum.runs));
    }
  }
  return means;
}

}  // namespace

std::vector<Comparison> compare_with_control(const Results& results) {
  const std::vector<std::vector<double>> ratios = mean_ratios(results);
  std::vector<Comparison> rows;
  std::vector<double> p;
  for (std::size_t solver = 1; solver < ratios.size(); ++solver) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < results.cases.size(); ++i) {
      const double difference = ratios[solver][i] - ratios[0][i];
      if (!std::isnan(difference)) differences.push_back(difference);
    }
    rows.push_back({.solver = solver,
                    .test = signed_rank_test(differences),
                    .holm_p = kUnknown,
                    .median_difference = quantile(differences, 0.5)});
    p.push_back(differences.empty() ? kUnknown : rows.back().test.p);
  }
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].holm_p = corrected[i];
  return rows;
}

}  // namespace nbvopt::study
