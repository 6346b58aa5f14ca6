#include "study/evaluate/cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/made_results.hpp"

namespace nbvopt::study {
namespace {

/// Two maps, two motion times each: cases 0, 1 in the room and 2, 3 in the hall; 4 without limit.
Results results_of_two_maps() {
  Results results = made_results({"auto", "random"}, {1.0, 1.0, 1.0, 1.0, 1.0});
  results.cases[0].motion_time_s = 2.0;
  results.cases[2].map = results.cases[3].map = "hall.ot";
  results.cases[3].motion_time_s = 2.0;
  results.cases[4].motion_time_s = 0.0;
  return results;
}

Run run_of(std::size_t case_index, double gain, double move_time_s) {
  auto run = made_run({.case_index = case_index, .gain = gain, .time_ms = 500.0});
  run.move_time_s = move_time_s;
  run.current_gain = 30.0;
  return run;
}

TEST(Cycle, IsGainOverMotionAndComputing) {
  Results results = results_of_two_maps();
  results.runs = {run_of(0, 300.0, 1.0), run_of(1, 90.0, 1.0),
                  failed_run({.case_index = 2, .time_ms = 500.0}), run_of(3, 100.0, 1.5),
                  run_of(4, 60.0, 5.5)};
  const std::vector<Cycle> rows = cycles(results);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0].motion_time_s, 0.0);
  EXPECT_EQ(rows[0].gain_per_s_moving, 10.0);
  EXPECT_TRUE(std::isnan(rows[0].gain_per_s_waiting)) << "no slot to wait for";
  EXPECT_EQ(rows[1].motion_time_s, 1.0);
  EXPECT_EQ(rows[1].runs, 2U);
  EXPECT_EQ(rows[1].mean_gain, 45.0) << "a failed run gains nothing";
  EXPECT_EQ(rows[1].mean_move_time_s, 1.0);
  EXPECT_EQ(rows[1].gain_per_s_moving, 30.0);
  EXPECT_EQ(rows[1].gain_per_s_waiting, 30.0);
  EXPECT_EQ(rows[1].added_per_s_waiting, 20.0);
  EXPECT_EQ(rows[2].mean_gain, 200.0);
  EXPECT_DOUBLE_EQ(rows[2].gain_per_s_moving, 400.0 / 3.5) << "of all, not a mean of quotients";
  EXPECT_EQ(rows[2].gain_per_s_waiting, 80.0);
  EXPECT_EQ(rows[3].solver, 1U);
  EXPECT_EQ(rows[3].runs, 0U);
  EXPECT_TRUE(std::isnan(rows[3].mean_gain));
}

TEST(BestMotionTime, HasTheGreatestRateOfEachMap) {
  Results results = results_of_two_maps();
  // In the room the short slot has 60 / 1.5 s and the long one 90 / 1.4 s, or 90 / 2.5 s by slots.
  results.runs = {run_of(0, 90.0, 0.9), run_of(1, 60.0, 1.0), run_of(2, 50.0, 1.0),
                  run_of(3, 60.0, 1.5)};
  const std::vector<BestMotionTime> rows = best_motion_times(results);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].map, "room.ot");
  EXPECT_EQ(rows[0].moving_s, 2.0);
  EXPECT_EQ(rows[0].waiting_s, 1.0);
  EXPECT_EQ(rows[0].adding_s, 2.0) << "60 / 2.5 s against 30 / 1.5 s";
  EXPECT_EQ(rows[1].map, "hall.ot");
  EXPECT_EQ(rows[1].moving_s, 1.0);
  EXPECT_EQ(rows[1].waiting_s, 1.0);
  EXPECT_EQ(rows[2].solver, 1U);
  EXPECT_TRUE(std::isnan(rows[2].moving_s));
}

}  // namespace
}  // namespace nbvopt::study
