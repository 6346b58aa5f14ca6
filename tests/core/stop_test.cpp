#include "nbvopt/core/stop.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

using std::chrono::microseconds;

TEST(StopRule, EndsAfterItsTime) {
  const StopRule::Clock::time_point since = StopRule::Clock::now();
  EXPECT_EQ(StopRule::within(2.5, since).deadline, since + microseconds(2500));
  EXPECT_TRUE(StopRule::within(1.0, since - microseconds(1000)).is_expired());

  const StopRule from_now = StopRule::within(60e3);
  EXPECT_GE(*from_now.deadline, since + std::chrono::minutes(1));
  EXPECT_FALSE(from_now.is_expired());
  EXPECT_EQ(from_now.max_evaluations, StopRule{}.max_evaluations) << "time alone is limited";
}

TEST(StopRule, NeverEndsByDefault) {
  EXPECT_FALSE(StopRule{}.deadline);
  EXPECT_FALSE(StopRule{}.is_expired());
}

}  // namespace
}  // namespace nbvopt
