#include "study/evaluate/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/made_results.hpp"

namespace nbvopt::study {
namespace {

/// The control has 90 % everywhere, in six cases of which the last has no reference.
Results results_of_control() {
  Results results =
      made_results({"auto", "better", "same", "missing"},
                   {100.0, 100.0, 100.0, 100.0, 100.0, std::numeric_limits<double>::quiet_NaN()});
  for (std::size_t i = 0; i < results.cases.size(); ++i) {
    results.runs.push_back(made_run({.case_index = i, .solver = 0, .gain = 90.0}));
    results.runs.push_back(made_run({.case_index = i, .solver = 2, .gain = 90.0}));
  }
  return results;
}

TEST(Comparison, AveragesOverSeedsBeforeItCompares) {
  Results results = results_of_control();
  for (std::size_t i = 0; i < results.cases.size(); ++i) {
    const double more = 1.0 + static_cast<double>(i);
    results.runs.push_back(
        made_run({.case_index = i, .solver = 1, .gain = 100.0 + more, .seed = 1}));
    results.runs.push_back(
        made_run({.case_index = i, .solver = 1, .gain = 80.0 + more, .seed = 2}));
  }
  sort_runs(results);
  const std::vector<Comparison> rows = compare_with_control(results);
  ASSERT_EQ(rows.size(), 3U);
  const Comparison& better = rows[0];
  EXPECT_EQ(better.solver, 1U);
  EXPECT_EQ(better.test.pairs, 5U) << "cases with a reference, not runs";
  EXPECT_NEAR(better.test.p, 0.0625, 1e-15) << "2 / 2^5, the least that five pairs can show";
  EXPECT_NEAR(better.holm_p, 0.125, 1e-15) << "two comparisons were made";
  EXPECT_NEAR(better.median_difference, 0.03, 1e-12);
  EXPECT_EQ(better.test.rank_biserial, 1.0);

  const Comparison& same = rows[1];
  EXPECT_EQ(same.test.zeros, 5U);
  EXPECT_EQ(same.test.p, 1.0);
  EXPECT_EQ(same.holm_p, 1.0);

  const Comparison& missing = rows[2];
  EXPECT_EQ(missing.test.pairs + missing.test.zeros, 0U);
  EXPECT_TRUE(std::isnan(missing.holm_p));
  EXPECT_TRUE(std::isnan(missing.median_difference));
}

TEST(Comparison, CountsAFailedRunAsNothing) {
  Results results = results_of_control();
  results.runs.push_back(failed_run({.case_index = 0, .solver = 1}));
  sort_runs(results);
  EXPECT_NEAR(compare_with_control(results)[0].median_difference, -0.9, 1e-12);
}

TEST(Comparison, LooksAtTheLoosestBudget) {
  Results results = results_of_control();
  results.budgets = {{100, 0.0}, {10, 0.0}};
  results.runs.push_back(made_run({.case_index = 0, .solver = 1, .gain = 95.0, .budget = 0}));
  results.runs.push_back(made_run({.case_index = 0, .solver = 1, .gain = 10.0, .budget = 1}));
  sort_runs(results);
  EXPECT_NEAR(compare_with_control(results)[0].median_difference, 0.05, 1e-12);
}

TEST(Comparison, OfTheControlAloneIsEmpty) {
  EXPECT_TRUE(compare_with_control(made_results({"auto"}, {1.0})).empty());
}

}  // namespace
}  // namespace nbvopt::study
