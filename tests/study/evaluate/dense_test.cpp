#include "study/evaluate/dense.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/made_results.hpp"

namespace nbvopt::study {
namespace {

Run with_dense(Run run, double dense_gain) {
  run.dense_gain = dense_gain;
  return run;
}

TEST(DenseSummary, IsOverTheBestThatIsKnownOfACase) {
  Results results = made_results({"auto", "random"}, {100.0, 10.0, 5.0});
  results.cases[0].dense_gain = 1000.0;
  results.cases[1].dense_gain = 80.0;  // the search's view is better by all pixels
  results.runs = {with_dense(made_run({.case_index = 0, .gain = 99.0}), 900.0),
                  with_dense(made_run({.case_index = 1, .gain = 9.0}), 100.0),
                  with_dense(made_run({.case_index = 2, .gain = 3.0}), 30.0),
                  with_dense(made_run({.case_index = 0, .solver = 1, .gain = 50.0}), 500.0),
                  failed_run({.case_index = 1, .solver = 1})};
  sort_runs(results);
  const std::vector<DenseSummary> rows = summarise_dense(results);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].runs, 2U) << "the third case's reference has no dense gain";
  EXPECT_DOUBLE_EQ(rows[0].mean_ratio, 0.95);
  EXPECT_DOUBLE_EQ(rows[0].worst_ratio, 0.9);
  EXPECT_LE(rows[0].mean_interval.low, 0.95);
  EXPECT_GE(rows[0].mean_interval.high, 0.95);
  EXPECT_DOUBLE_EQ(rows[1].mean_ratio, 0.25) << "a failed run counts 0";
  EXPECT_EQ(rows[1].worst_ratio, 0.0);
  EXPECT_DOUBLE_EQ(dense_ratio_of_references(results), 0.9);
}

TEST(DenseSummary, IsEmptyForOlderRecords) {
  Results results = made_results({"auto"}, {100.0});
  results.runs = {made_run({.case_index = 0, .gain = 99.0})};
  EXPECT_TRUE(summarise_dense(results).empty());
  EXPECT_TRUE(std::isnan(dense_ratio_of_references(results)));
}

}  // namespace
}  // namespace nbvopt::study
