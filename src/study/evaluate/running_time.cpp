#include "study/evaluate/running_time.hpp"

#include <algorithm>

#include "study/evaluate/ratio.hpp"

namespace nbvopt::study {

Cost whole_cost(const Run& run) {
  return {static_cast<double>(run.evaluations + run.surrogate_evaluations), run.search_time_ms};
}

std::optional<Cost> cost_to_reach(const Results& results, const Run& run, double target) {
  if (run.has_failed() || !(gain_ratio(results, run) >= target)) return std::nullopt;
  const double reference = results.cases[run.case_index].reference_gain;
  const auto first = std::ranges::partition_point(run.progress, [&](const ProgressStep& step) {
    return reference > 0.0 && step.gain / reference < target;
  });
  if (first == run.progress.end()) return whole_cost(run);
  return Cost{static_cast<double>(first->evaluations), first->time_ms};
}

std::vector<ExpectedRunningTime> expected_running_times(const Results& results,
                                                        const std::vector<double>& targets) {
  std::vector<ExpectedRunningTime> rows;
  for (std::size_t solver = 0; solver < results.solvers.size(); ++solver) {
    for (const double target : targets) {
      rows.push_back(
          {.solver = solver, .target = target, .runs = 0, .successes = 0, .expected = {}});
    }
  }
  const std::size_t budget = loosest_budget(results);
  for (const Run& run : results.runs) {
    if (run.budget != budget || !has_reference(results, run)) continue;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      ExpectedRunningTime& row = rows[run.solver * targets.size() + i];
      const std::optional<Cost> reached = cost_to_reach(results, run, targets[i]);
      const Cost spent = reached.value_or(whole_cost(run));
      ++row.runs;
      if (reached) ++row.successes;
      row.expected.evaluations += spent.evaluations;
      row.expected.time_ms += spent.time_ms;
    }
  }
  for (ExpectedRunningTime& row : rows) {
    // A failed run may have cost nothing: 0 / 0 is no running time.
    const double successes = static_cast<double>(row.successes);
    const auto over_successes = [&](double& cost) {
      if (row.runs > 0 && row.successes == 0) cost = 1.0;
      cost /= successes;
    };
    over_successes(row.expected.evaluations);
    over_successes(row.expected.time_ms);
  }
  return rows;
}

}  // namespace nbvopt::study
