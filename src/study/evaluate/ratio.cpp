#include "study/evaluate/ratio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "nbvopt/core/error.hpp"

namespace nbvopt::study {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Greater for looser budgets.
std::tuple<bool, double, double> looseness(const Budget& budget) {
  const auto unless_zero = [](double limit) { return limit > 0.0 ? limit : kInfinity; };
  return {!(budget.time_limit_ms > 0.0), unless_zero(budget.time_limit_ms),
          unless_zero(static_cast<double>(budget.max_evaluations))};
}

}  // namespace

double gain_ratio(const Results& results, const Run& run) {
  const double reference = results.cases[run.case_index].reference_gain;
  if (std::isnan(reference)) return reference;
  if (run.has_failed()) return 0.0;
  return reference > 0.0 ? run.gain / reference : 1.0;
}

bool has_reference(const Results& results, const Run& run) {
  return !std::isnan(results.cases[run.case_index].reference_gain);
}

std::size_t loosest_budget(const Results& results) {
  const auto& budgets = results.budgets;
  if (budgets.empty()) throw UsageError("the study " + results.study + " has no budget");
  const auto loosest = std::ranges::max_element(budgets, {}, looseness);
  return static_cast<std::size_t>(loosest - budgets.begin());
}

Excess excess_over_reference(const Results& results) {
  Excess excess;
  for (const Run& run : results.runs) {
    const double reference = results.cases[run.case_index].reference_gain;
    if (run.has_failed() || !(run.gain > reference)) continue;  // nor where it is NaN
    ++excess.runs;
    if (!(reference > 0.0)) ++excess.despite_no_gain;
    excess.greatest_ratio = std::max(excess.greatest_ratio, gain_ratio(results, run));
  }
  return excess;
}

}  // namespace nbvopt::study
