#include "planner/plan_message.hpp"

#include <gtest/gtest.h>

namespace nbvopt {
namespace {

PlanResult result_with(double unknown_gain, double occupied_gain, double current_gain,
                       std::vector<std::string> active_bounds) {
  PlanResult result;
  result.view.gain = unknown_gain + occupied_gain;
  result.view.unknown_gain = unknown_gain;
  result.view.occupied_gain = occupied_gain;
  result.current.gain = current_gain;
  result.active_bounds = std::move(active_bounds);
  return result;
}

TEST(PlanMessage, SaysWhatIsGainedWhereAndWhatHoldsItBack) {
  EXPECT_EQ(gain_message(result_with(1170.0, 20.34, 8.5, {"tilt_max", "height_min"})),
            "move: gain 1190.3, 1181.8 more than staying; 98 % of it from unknown space, 2 % from "
            "badly seen surfaces; tilt and height are at their limits");
  EXPECT_EQ(gain_message(result_with(0.0, 20.0, 8.0, {"pan_max"})),
            "move: gain 20, 12 more than staying; 0 % of it from unknown space, 100 % from badly "
            "seen surfaces; pan is at its limit");
  EXPECT_EQ(gain_message(result_with(3.0, 1.0, 4.0, {"pan_max", "tilt_min", "height_max"})),
            "stay: no evaluated view is better, gain 4; 75 % of it from unknown space, 25 % from "
            "badly seen surfaces; pan, tilt and height are at their limits");
}

TEST(PlanMessage, SaysNothingOfWhereNoGainComesFrom) {
  EXPECT_EQ(gain_message(result_with(0.0, 0.0, 0.0, {})),
            "stay: no evaluated view is better, gain 0");
}

}  // namespace
}  // namespace nbvopt
