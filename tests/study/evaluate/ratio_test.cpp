#include "study/evaluate/ratio.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nbvopt/core/error.hpp"
#include "study/made_results.hpp"
#include "support/numbers.hpp"

namespace nbvopt::study {
namespace {

using test::kNaN;

TEST(GainRatio, IsTheShareOfTheReference) {
  const Results results = made_results({"auto"}, {200.0});
  EXPECT_EQ(gain_ratio(results, made_run({.gain = 150.0})), 0.75);
  EXPECT_EQ(gain_ratio(results, made_run({.gain = 201.0})), 1.005) << "not clipped";
  EXPECT_EQ(gain_ratio(results, failed_run({})), 0.0);
}

TEST(GainRatio, OfNothingToBeHadIsOne) {
  const Results results = made_results({"auto"}, {0.0});
  EXPECT_EQ(gain_ratio(results, made_run({.gain = 0.0})), 1.0);
  EXPECT_EQ(gain_ratio(results, failed_run({})), 0.0);
}

TEST(GainRatio, WithoutAReferenceIsNone) {
  const Results results = made_results({"auto"}, {kNaN});
  EXPECT_TRUE(std::isnan(gain_ratio(results, made_run({.gain = 1.0}))));
  EXPECT_TRUE(std::isnan(gain_ratio(results, failed_run({}))));
  EXPECT_FALSE(has_reference(results, made_run({})));
}

TEST(LoosestBudget, IsTheLoosestOfThoseWithoutATimeLimit) {
  Results results = made_results({"auto"}, {1.0});
  results.budgets = {{100, 0.0}, {1000, 0.0}, {0, 50.0}, {0, 500.0}};
  EXPECT_EQ(loosest_budget(results), 1U);
  results.budgets = {{100, 0.0}, {0, 0.0}, {0, 50.0}};
  EXPECT_EQ(loosest_budget(results), 1U) << "no limit at all";
  results.budgets = {{0, 50.0}, {0, 500.0}};
  EXPECT_EQ(loosest_budget(results), 1U);
  results.budgets = {{100, 500.0}, {1000, 500.0}, {1000, 50.0}};
  EXPECT_EQ(loosest_budget(results), 1U);
  results.budgets.clear();
  EXPECT_THROW(loosest_budget(results), UsageError);
}

TEST(Excess, IsTheGreatestOfAllRuns) {
  Results results = made_results({"auto"}, {100.0, 0.0, kNaN});
  EXPECT_EQ(excess_over_reference(results).greatest_ratio, 1.0);
  results.runs = {
      made_run({.case_index = 0, .gain = 100.0}), made_run({.case_index = 0, .gain = 101.0}),
      made_run({.case_index = 0, .gain = 102.0}), failed_run({.case_index = 0}),
      made_run({.case_index = 1, .gain = 5.0}),   made_run({.case_index = 2, .gain = 7.0})};
  const Excess excess = excess_over_reference(results);
  EXPECT_EQ(excess.runs, 3U);
  EXPECT_EQ(excess.greatest_ratio, 1.02);
  EXPECT_EQ(excess.despite_no_gain, 1U);
}

}  // namespace
}  // namespace nbvopt::study
