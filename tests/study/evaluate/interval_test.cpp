#include "study/evaluate/interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace nbvopt::study {
namespace {

/// Cases of some maps, so many starts each.
std::vector<CaseResult> cases_of(std::size_t maps, std::size_t starts) {
  std::vector<CaseResult> cases;
  for (std::size_t map = 0; map < maps; ++map) {
    for (std::size_t start = 0; start < starts; ++start) {
      cases.push_back({.map = "map" + std::to_string(map), .start = start});
    }
  }
  return cases;
}

TEST(MeanInterval, IsThatOfAMeanOfIndependentStartsOnOneMap) {
  const std::vector<CaseResult> cases = cases_of(1, 400);
  std::vector<CaseValue> values;
  for (std::size_t i = 0; i < cases.size(); ++i)
    values.push_back({&cases[i], i % 2 == 0 ? 0.0 : 1.0});
  const Interval interval = mean_interval(values);
  // 1.96 times the deviation of the mean: 0.5 / sqrt(400).
  EXPECT_NEAR(interval.low, 0.5 - 0.049, 0.005);
  EXPECT_NEAR(interval.high, 0.5 + 0.049, 0.005);
}

TEST(MeanInterval, CountsMapsNotStarts) {
  const std::vector<CaseResult> cases = cases_of(4, 100);
  std::vector<CaseValue> values;
  for (std::size_t i = 0; i < cases.size(); ++i) values.push_back({&cases[i], i < 200 ? 0.0 : 1.0});
  // Of four maps drawn, all are alike with probability 1/16 a side.
  const Interval interval = mean_interval(values);
  EXPECT_EQ(interval.low, 0.0);
  EXPECT_EQ(interval.high, 1.0);
}

TEST(MeanInterval, KeepsTheCasesOfAStartTogether) {
  std::vector<CaseResult> cases = cases_of(1, 2);
  // Whatever start is drawn, its two motion times have the mean 0.5.
  std::vector<CaseValue> values;
  for (const CaseResult& one : cases) {
    values.push_back({&one, 0.0});
    values.push_back({&one, 1.0});
  }
  const Interval interval = mean_interval(values);
  EXPECT_EQ(interval.low, 0.5);
  EXPECT_EQ(interval.high, 0.5);
}

TEST(MeanInterval, IsUnknownOfNothing) {
  EXPECT_TRUE(std::isnan(mean_interval({}).low));
  EXPECT_TRUE(std::isnan(mean_interval({}).high));
}

}  // namespace
}  // namespace nbvopt::study
