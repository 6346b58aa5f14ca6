#include "study/evaluate/modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/made_results.hpp"

namespace nbvopt::study {
namespace {

/// Starts 0 and 1, each asked by distance (cases 0, 1) and by both (cases 2, 3).
Results results_of_two_modes() {
  Results results = made_results({"auto", "random"}, {1.0, 1.0, 1.0, 1.0});
  for (std::size_t i = 0; i < 4; ++i) {
    results.cases[i].start = i % 2;
    results.cases[i].mode = i < 2 ? UncertaintyMode::distance : UncertaintyMode::both;
  }
  return results;
}

Run judged(std::size_t case_index, const std::array<double, 3>& gain_by_mode) {
  auto run = made_run({.case_index = case_index});
  run.gain_by_mode = gain_by_mode;
  return run;
}

TEST(Modes, ComparesAnswersAsEachModeJudgesThem) {
  Results results = results_of_two_modes();
  results.runs = {judged(0, {10.0, 4.0, 3.0}), judged(1, {20.0, 6.0, 5.0}),
                  judged(2, {6.0, 7.0, 8.0}), judged(3, {18.0, 9.0, 8.0})};
  const std::optional<ModeTable> table = compare_modes(results);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->ratio[0][0], 1.0);
  EXPECT_EQ(table->ratio[2][2], 1.0);
  EXPECT_EQ(table->ratio[0][2], 0.5) << "(3 + 5) / (8 + 8)";
  EXPECT_EQ(table->ratio[2][0], 0.8) << "(6 + 18) / (10 + 20)";
  EXPECT_EQ(table->pairs[2][0], 2U);
  EXPECT_TRUE(std::isnan(table->ratio[0][1])) << "nobody chose by angle";
  EXPECT_EQ(table->pairs[0][1], 0U);
}

TEST(Modes, ComparesOnlyWhatBothAnswered) {
  Results results = results_of_two_modes();
  auto failed = judged(1, {0.0, 0.0, 0.0});
  failed.failure = "crashed";
  auto of_another = judged(1, {999.0, 999.0, 999.0});
  of_another.solver = 1;
  results.runs = {judged(0, {10.0, 4.0, 3.0}), failed, of_another, judged(2, {6.0, 7.0, 8.0}),
                  judged(3, {18.0, 9.0, 8.0})};
  const std::optional<ModeTable> table = compare_modes(results);
  EXPECT_EQ(table->ratio[0][2], 3.0 / 8.0);
  EXPECT_EQ(table->pairs[0][2], 1U);
}

TEST(Modes, OfOneModeAreNoQuestion) {
  EXPECT_FALSE(compare_modes(made_results({"auto"}, {1.0, 1.0})));
  EXPECT_FALSE(compare_modes(made_results({"auto"}, {})));
}

}  // namespace
}  // namespace nbvopt::study
