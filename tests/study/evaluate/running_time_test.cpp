#include "study/evaluate/running_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/made_results.hpp"

namespace nbvopt::study {
namespace {

/// Steps at 1, 20 and 50 evaluations with half, 95 % and 99 % of 1000; the answer has 99.5 %.
Run stepwise() {
  auto run = made_run({.gain = 995.0, .evaluations = 40, .time_ms = 9.0});
  run.surrogate_evaluations = 60;
  run.progress = {{.evaluations = 1, .exact_evaluations = 1, .time_ms = 0.1, .gain = 500.0},
                  {.evaluations = 20, .exact_evaluations = 5, .time_ms = 2.0, .gain = 950.0},
                  {.evaluations = 50, .exact_evaluations = 20, .time_ms = 4.0, .gain = 990.0}};
  return run;
}

TEST(CostToReach, IsThatOfTheFirstStepThatReaches) {
  const Results results = made_results({"auto"}, {1000.0});
  EXPECT_EQ(cost_to_reach(results, stepwise(), 0.3)->evaluations, 1.0);
  EXPECT_EQ(cost_to_reach(results, stepwise(), 0.95)->evaluations, 20.0);
  EXPECT_EQ(cost_to_reach(results, stepwise(), 0.95)->time_ms, 2.0);
  EXPECT_EQ(cost_to_reach(results, stepwise(), 0.96)->evaluations, 50.0);
}

TEST(CostToReach, OfAnAnswerBetterThanAllStepsIsTheWholeRuns) {
  const Results results = made_results({"auto"}, {1000.0});
  EXPECT_EQ(cost_to_reach(results, stepwise(), 0.995)->evaluations, 100.0);
  EXPECT_EQ(cost_to_reach(results, stepwise(), 0.995)->time_ms, 9.0);
  EXPECT_FALSE(cost_to_reach(results, stepwise(), 0.999));
}

TEST(CostToReach, TheAnswerDecides) {
  const Results results = made_results({"auto"}, {1000.0});
  auto run = stepwise();
  run.gain = 940.0;
  EXPECT_FALSE(cost_to_reach(results, run, 0.95));
  run.failure = "crashed";
  EXPECT_FALSE(cost_to_reach(results, run, 0.1));
}

TEST(CostToReach, OfNothingToBeHadIsTheFirstStep) {
  EXPECT_EQ(cost_to_reach(made_results({"auto"}, {0.0}), stepwise(), 0.999)->evaluations, 1.0);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cost_to_reach(made_results({"auto"}, {none}), stepwise(), 0.5));
}

TEST(ExpectedRunningTime, WithoutFailureIsTheMean) {
  Results results = made_results({"auto"}, {100.0, 100.0, 100.0});
  for (std::size_t i = 0; i < 3; ++i) {
    results.runs.push_back(made_run({.case_index = i,
                                     .gain = 100.0,
                                     .evaluations = 10 + static_cast<std::int64_t>(i),
                                     .time_ms = 1.0 + static_cast<double>(i)}));
  }
  const auto rows = expected_running_times(results, {0.99});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].successes, 3U);
  EXPECT_DOUBLE_EQ(rows[0].expected.evaluations, 11.0);
  EXPECT_DOUBLE_EQ(rows[0].expected.time_ms, 2.0);
}

TEST(ExpectedRunningTime, ChargesFailuresToTheSuccesses) {
  Results results =
      made_results({"auto", "random"}, {100.0, 100.0, std::numeric_limits<double>::quiet_NaN()});
  results.budgets = {{10, 0.0}, {100, 0.0}};
  results.runs = {
      made_run({.case_index = 0, .gain = 100.0, .evaluations = 10, .seed = 1, .budget = 1}),
      made_run({.case_index = 0, .gain = 98.0, .evaluations = 60, .seed = 2, .budget = 1}),
      failed_run({.case_index = 1, .evaluations = 7, .time_ms = 3.0, .seed = 1, .budget = 1}),
      made_run({.case_index = 1, .gain = 100.0, .evaluations = 20, .seed = 2, .budget = 1}),
      made_run({.case_index = 2, .gain = 100.0, .evaluations = 999, .budget = 1}),
      made_run({.case_index = 0, .gain = 100.0, .evaluations = 999, .budget = 0}),
      made_run({.case_index = 0, .solver = 1, .gain = 90.0, .budget = 1})};
  sort_runs(results);
  const auto rows = expected_running_times(results, {0.95, 0.99});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].runs, 4U) << "neither other budgets nor cases without a reference";
  EXPECT_EQ(rows[0].successes, 3U);
  EXPECT_DOUBLE_EQ(rows[0].expected.evaluations, (10.0 + 60.0 + 7.0 + 20.0) / 3.0);
  EXPECT_EQ(rows[1].target, 0.99);
  EXPECT_EQ(rows[1].successes, 2U);
  EXPECT_DOUBLE_EQ(rows[1].expected.evaluations, 48.5);
  EXPECT_DOUBLE_EQ(rows[1].expected.time_ms, 3.0);
  EXPECT_EQ(rows[3].successes, 0U);
  EXPECT_TRUE(std::isinf(rows[3].expected.evaluations)) << "never reached";
  EXPECT_TRUE(std::isinf(rows[3].expected.time_ms));
}

TEST(ExpectedRunningTime, WithoutCostIsInfiniteWithoutSuccessAndNoneWithoutRuns) {
  Results results = made_results({"auto", "random"}, {100.0});
  results.runs = {failed_run({.evaluations = 0, .time_ms = 0.0})};
  const auto rows = expected_running_times(results, {0.95});
  EXPECT_TRUE(std::isinf(rows[0].expected.evaluations));
  EXPECT_TRUE(std::isnan(rows[1].expected.evaluations));
}

}  // namespace
}  // namespace nbvopt::study
