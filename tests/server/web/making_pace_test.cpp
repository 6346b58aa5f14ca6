#include "server/web/making_pace.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const MakingPace::Clock::time_point kStart{seconds(1000)};

TEST(MakingPace, LetsALargeMapBeFollowedAtOnce) {
  MakingPace pace(milliseconds(100));
  EXPECT_TRUE(pace.allows(kStart));
  pace.took(kStart, kStart + seconds(6));
  EXPECT_FALSE(pace.allows(kStart + seconds(6)));
  EXPECT_TRUE(pace.allows(kStart + seconds(6) + milliseconds(100)));
}

TEST(MakingPace, TakesAFifthOfACoreInTheLongRun) {
  MakingPace pace(milliseconds(100));
  seconds made{0};
  for (seconds now{0}; now < seconds(1000);) {
    if (!pace.allows(kStart + now)) {
      now += seconds(1);
      continue;
    }
    pace.took(kStart + now, kStart + now + seconds(4));
    now += seconds(4);
    made += seconds(4);
  }
  EXPECT_GE(made, seconds(150));
  EXPECT_LE(made, seconds(220));
}

TEST(MakingPace, SavesNoMoreThanItMay) {
  MakingPace pace(milliseconds(100));
  pace.took(kStart, kStart + seconds(1));
  const auto later = kStart + seconds(100'000);
  pace.took(later, later + seconds(11));
  EXPECT_FALSE(pace.allows(later + seconds(12)));
}

}  // namespace
}  // namespace nbvopt
