#include "study/evaluate/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/made_results.hpp"

namespace nbvopt::study {
namespace {

TEST(Quantile, IsThatOfNumPy) {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0, 10.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.5), 3.0);
  EXPECT_NEAR(quantile(values, 0.99), 9.76, 1e-12);  // numpy.percentile(values, 99)
  EXPECT_EQ(quantile(values, 1.0), 10.0);
  EXPECT_EQ(quantile({1.0, 2.0}, 0.5), 1.5);
  EXPECT_EQ(quantile({7.0}, 0.99), 7.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_TRUE(std::isnan(mean({})));
}

TEST(Summary, IsOfEachSolverWithinEachBudget) {
  Results results =
      made_results({"auto", "random"}, {100.0, 10.0, std::numeric_limits<double>::quiet_NaN()});
  results.budgets = {{10, 0.0}, {100, 0.0}};
  auto with_surrogate = made_run({.case_index = 0, .gain = 99.0, .time_ms = 2.0, .budget = 1});
  with_surrogate.surrogate_evaluations = 500;
  results.runs = {
      with_surrogate,
      made_run({.case_index = 1, .gain = 9.0, .evaluations = 30, .time_ms = 4.0, .budget = 1}),
      made_run({.case_index = 2, .gain = 3.0, .evaluations = 20, .time_ms = 6.0, .budget = 1}),
      made_run({.case_index = 0, .solver = 1, .gain = 50.0, .budget = 1}),
      failed_run({.case_index = 1, .solver = 1, .evaluations = 0, .budget = 1})};
  sort_runs(results);
  const std::vector<Summary> rows = summarise(results);
  ASSERT_EQ(rows.size(), 4U);

  EXPECT_EQ(rows[0].runs, 0U);
  EXPECT_TRUE(std::isnan(rows[0].mean_ratio));

  const Summary& control = rows[1];
  EXPECT_EQ(control.solver, 0U);
  EXPECT_EQ(control.budget, 1U);
  EXPECT_EQ(control.runs, 3U);
  EXPECT_EQ(control.failures, 0U);
  EXPECT_DOUBLE_EQ(control.mean_ratio, 0.945);
  EXPECT_DOUBLE_EQ(control.median_ratio, 0.945);
  EXPECT_EQ(control.worst_ratio, 0.9);
  EXPECT_EQ(control.mean_exact_evaluations, 20.0);
  EXPECT_DOUBLE_EQ(control.mean_surrogate_evaluations, 500.0 / 3.0);
  EXPECT_EQ(control.mean_search_time_ms, 4.0);
  EXPECT_NEAR(control.p99_search_time_ms, 5.96, 1e-12);

  const Summary& random = rows[3];
  EXPECT_EQ(random.runs, 2U);
  EXPECT_EQ(random.failures, 1U);
  EXPECT_EQ(random.mean_ratio, 0.25) << "a failed run counts 0";
  EXPECT_EQ(random.worst_ratio, 0.0);
  EXPECT_EQ(random.mean_exact_evaluations, 10.0) << "of the runs with an answer";
}

}  // namespace
}  // namespace nbvopt::study
