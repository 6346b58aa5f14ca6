#include "nbvopt/sim/information_growth.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

/// 10 from 0 s, 30 from 1 s, 40 from 3 s.
InformationGrowth steps() {
  InformationGrowth growth;
  growth.add(0.0, 10.0);
  growth.add(1.0, 30.0);
  growth.add(3.0, 40.0);
  return growth;
}

TEST(InformationGrowth, TellsWhenSoMuchWasThere) {
  EXPECT_EQ(steps().time_to_s(5.0), 0.0);
  EXPECT_EQ(steps().time_to_s(10.0), 0.0);
  EXPECT_EQ(steps().time_to_s(10.1), 1.0);
  EXPECT_EQ(steps().time_to_s(40.0), 3.0);
  EXPECT_FALSE(steps().time_to_s(40.1));
  EXPECT_FALSE(InformationGrowth().time_to_s(1.0));
}

TEST(InformationGrowth, StaysFromOneCaptureToTheNext) {
  EXPECT_EQ(steps().at(-0.1), 0.0);
  EXPECT_EQ(steps().at(0.0), 10.0);
  EXPECT_EQ(steps().at(2.9), 30.0);
  EXPECT_EQ(steps().at(3.0), 40.0);
  EXPECT_EQ(steps().at(100.0), 40.0);
  EXPECT_EQ(InformationGrowth().at(1.0), 0.0);
}

TEST(InformationGrowth, AveragesOverTime) {
  EXPECT_DOUBLE_EQ(steps().mean_until(4.0), (10.0 + 2 * 30.0 + 40.0) / 4.0);
  EXPECT_DOUBLE_EQ(steps().mean_until(2.0), (10.0 + 30.0) / 2.0) << "what comes later is cut off";
  EXPECT_EQ(steps().mean_until(0.0), 0.0);
  EXPECT_EQ(InformationGrowth().mean_until(1.0), 0.0);
}

TEST(InformationGrowth, ThinsButKeepsBothEnds) {
  InformationGrowth growth;
  for (int i = 0; i <= 1000; ++i) growth.add(i, 2.0 * i);
  const InformationGrowth thin = growth.thinned(11);
  ASSERT_EQ(thin.points().size(), 11U);
  for (int i = 0; i <= 10; ++i) EXPECT_EQ(thin.points()[i].time_s, 100.0 * i);
  EXPECT_EQ(steps().thinned(3).points(), steps().points());
}

}  // namespace
}  // namespace nbvopt
