#include "nbvopt/mast/mast.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt {
namespace {

using test::kNaN;

using std::numbers::pi;
using test::message_of;
using testing::AllOf;
using testing::HasSubstr;

MastOptions limited_pan() {
  MastOptions options;
  options.pan_continuous = false;
  options.pan_min_rad = -1.0;
  options.pan_max_rad = 2.0;
  return options;
}

void expect_near(const Eigen::Vector3d& found, const Eigen::Vector3d& expected) {
  EXPECT_TRUE((found - expected).norm() < 1e-12)
      << "found " << found.transpose() << ", expected " << expected.transpose();
}

// Forward kinematics: the optical axes in the base frame, computed by hand.

TEST(MastKinematics, AtRestLooksAlongBaseX) {
  const Transform T = Mast(MastOptions{}).T_base_sensor({0.0, 0.0, 0.4});
  expect_near(T.translation(), {0.0, 0.0, 0.4});
  expect_near(T.linear().col(2), {1.0, 0.0, 0.0});   // forward
  expect_near(T.linear().col(0), {0.0, -1.0, 0.0});  // right
  expect_near(T.linear().col(1), {0.0, 0.0, -1.0});  // down
}

TEST(MastKinematics, PositivePanTurnsLeft) {
  const Transform T = Mast(MastOptions{}).T_base_sensor({pi / 2, 0.0, 0.4});
  expect_near(T.linear().col(2), {0.0, 1.0, 0.0});
  expect_near(T.linear().col(0), {1.0, 0.0, 0.0});
}

TEST(MastKinematics, PositiveTiltLooksUp) {
  const Transform T = Mast(MastOptions{}).T_base_sensor({0.0, 0.3, 0.4});
  expect_near(T.linear().col(2), {std::cos(0.3), 0.0, std::sin(0.3)});
  expect_near(T.linear().col(1), {std::sin(0.3), 0.0, -std::cos(0.3)});
}

TEST(MastKinematics, PanAndTiltCompose) {
  const Transform T = Mast(MastOptions{}).T_base_sensor({pi / 6, pi / 4, 0.2});
  const double s = std::sqrt(0.5);
  expect_near(T.linear().col(2), {s * std::sqrt(0.75), s * 0.5, s});
  expect_near(T.linear().col(0), {0.5, -std::sqrt(0.75), 0.0});
}

TEST(MastKinematics, OffsetTurnsWithPanAndTilt) {
  MastOptions options;
  options.sensor_offset_m << 0.1, 0.02, 0.05;
  const Mast mast(options);
  expect_near(mast.T_base_sensor({0.0, 0.0, 0.4}).translation(), {0.1, 0.02, 0.45});
  expect_near(mast.T_base_sensor({pi / 2, 0.0, 0.4}).translation(), {-0.02, 0.1, 0.45});
  const double s = std::sqrt(0.5);  // at a tilt of 45 degrees
  expect_near(mast.T_base_sensor({0.0, pi / 4, 0.4}).translation(),
              {s * (0.1 - 0.05), 0.02, 0.4 + s * (0.1 + 0.05)});
}

TEST(MastKinematics, PanTurnsAboutItsAxisWhereverItStands) {
  MastOptions options;
  options.pan_axis_x_m = -0.2;
  options.pan_axis_y_m = 0.1;
  options.sensor_offset_m << 0.1, 0.0, 0.0;
  const Mast mast(options);
  expect_near(mast.T_base_sensor({0.0, 0.0, 0.4}).translation(), {-0.1, 0.1, 0.4});
  expect_near(mast.T_base_sensor({pi / 2, 0.0, 0.4}).translation(), {-0.2, 0.2, 0.4});
}

// Algorithm 2's box.

TEST(ReachableBox, WithoutLimitIsTheJointsRangeAndOneTurn) {
  const JointBox box = Mast(MastOptions{}).reachable_box({5.0, 0.1, 0.3}, 0.0);
  EXPECT_EQ(box.min, Eigen::Vector3d(5.0 - pi, -0.79, 0.18));
  EXPECT_EQ(box.max, Eigen::Vector3d(5.0 + pi, 0.79, 0.63));
}

TEST(ReachableBox, OfATightTimeIsVelocityTimesTime) {
  const JointBox box = Mast(MastOptions{}).reachable_box({-0.5, 0.1, 0.4}, 0.2);
  expect_near(box.min, {-0.5 - 0.2 * pi, 0.0, 0.37});
  expect_near(box.max, {-0.5 + 0.2 * pi, 0.2, 0.43});
}

TEST(ReachableBox, IsCutAtTheLimits) {
  const JointBox box = Mast(limited_pan()).reachable_box({1.9, -0.79, 0.63}, 1.0);
  expect_near(box.min, {-1.0, -0.79, 0.48});
  expect_near(box.max, {2.0, -0.29, 0.63});
}

TEST(ReachableBox, OfALimitedPanWithoutLimitIsItsRange) {
  const JointBox box = Mast(limited_pan()).reachable_box({0.0, 0.0, 0.3}, 0.0);
  EXPECT_EQ(box.min[0], -1.0);
  EXPECT_EQ(box.max[0], 2.0);
}

TEST(ReachableBox, OfAContinuousPanNeverExceedsOneTurn) {
  const JointBox box = Mast(MastOptions{}).reachable_box({7.0, 0.0, 0.3}, 100.0);
  EXPECT_EQ(box.min[0], 7.0 - pi);
  EXPECT_EQ(box.max[0], 7.0 + pi);
}

TEST(ReachableBox, HoldsTheCurrentPositionToTheLastBit) {
  const Mast mast(MastOptions{});
  for (int i = 0; i <= 1000; ++i) {
    const double s = i / 1000.0;
    const JointPosition q{-9.0 + 18.0 * s, -0.79 + 1.58 * s * s, std::min(0.63, 0.18 + 0.45 * s)};
    const JointPosition inside{q.pan_rad, std::clamp(q.tilt_rad, -0.79, 0.79), q.height_m};
    for (const double t : {0.0, 1e-20, 1e-9, 0.1, 3.0}) {
      EXPECT_TRUE(mast.reachable_box(inside, t).contains(inside.vector())) << i << ' ' << t;
    }
  }
}

TEST(ReachableBox, RefusesABadTimeAndJointsBeyondLimits) {
  const Mast mast(MastOptions{});
  const JointPosition q{0.0, 0.0, 0.3};
  EXPECT_THAT(message_of<UsageError>([&] { mast.reachable_box(q, -0.5); }), HasSubstr("-0.5 s"));
  EXPECT_THROW(mast.reachable_box(q, kNaN), UsageError);
  EXPECT_THROW(mast.reachable_box({0.0, 0.8, 0.3}, 1.0), UsageError);
  EXPECT_THROW(mast.reachable_box({kNaN, 0.0, 0.3}, 1.0), UsageError);
}

TEST(MoveTime, IsThatOfTheSlowestJoint) {
  const Mast mast(MastOptions{});
  EXPECT_DOUBLE_EQ(mast.move_time_s({0.0, 0.0, 0.3}, {-pi, 0.1, 0.33}), 1.0);  // pan
  EXPECT_DOUBLE_EQ(mast.move_time_s({0.0, 0.0, 0.3}, {0.1, 0.4, 0.33}), 0.8);  // tilt
  EXPECT_DOUBLE_EQ(mast.move_time_s({0.0, 0.0, 0.6}, {0.1, 0.1, 0.3}), 2.0);   // height
  EXPECT_EQ(mast.move_time_s({0.0, 0.0, 0.3}, {0.0, 0.0, 0.3}), 0.0);
}

TEST(OnTheWay, MovesEachJointAtItsVelocityUntilItHasArrived) {
  const Mast mast(MastOptions{});
  const JointPosition from{0.0, 0.1, 0.3};
  const JointPosition to{-pi, 0.2, 0.6};
  EXPECT_EQ(mast.on_the_way(from, to, 0.0), from);
  const JointPosition half = mast.on_the_way(from, to, 0.5);
  EXPECT_DOUBLE_EQ(half.pan_rad, -pi / 2.0);
  EXPECT_EQ(half.tilt_rad, to.tilt_rad);
  EXPECT_DOUBLE_EQ(half.height_m, 0.375);
  EXPECT_EQ(mast.on_the_way(from, to, mast.move_time_s(from, to) + 0.001), to);
}

// Joints beyond their limits.

TEST(Clamped, LeavesWhatIsInsideAndTurnsOfAContinuousPan) {
  std::vector<std::string> warnings;
  const JointPosition q{20.0, 0.79, 0.18};
  EXPECT_EQ(Mast(MastOptions{}).clamped(q, warnings), q);
  EXPECT_TRUE(warnings.empty());
}

TEST(Clamped, MovesALittleAndSaysSo) {
  std::vector<std::string> warnings;
  const JointPosition q = Mast(limited_pan()).clamped({2.009, -0.799, 0.634}, warnings);
  EXPECT_EQ(q, (JointPosition{2.0, -0.79, 0.63}));
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_THAT(warnings[0], AllOf(HasSubstr("pan is 2.009 rad"), HasSubstr("-1 to 2 rad")));
  EXPECT_THAT(warnings[1], HasSubstr("tilt is -0.799 rad"));
  EXPECT_THAT(warnings[2], AllOf(HasSubstr("height is 0.634 m"), HasSubstr("0.18 to 0.63 m")));
}

TEST(Clamped, RefusesMore) {
  std::vector<std::string> warnings;
  const Mast mast(limited_pan());
  EXPECT_THAT(message_of<InputError>([&] {
                mast.clamped({2.02, 0.0, 0.3}, warnings);
              }),
              AllOf(HasSubstr("pan is 2.02 rad"), HasSubstr("-1 to 2 rad")));
  EXPECT_THAT(message_of<InputError>([&] {
                mast.clamped({0.0, -0.81, 0.3}, warnings);
              }),
              AllOf(HasSubstr("tilt is -0.81 rad"), HasSubstr("-0.79 to 0.79 rad")));
  EXPECT_THAT(message_of<InputError>([&] {
                mast.clamped({0.0, 0.0, 0.17}, warnings);
              }),
              AllOf(HasSubstr("height is 0.17 m"), HasSubstr("0.18 to 0.63 m")));
  EXPECT_THAT(message_of<InputError>([&] {
                mast.clamped({0.0, kNaN, 0.3}, warnings);
              }),
              HasSubstr("tilt is nan rad"));
  EXPECT_THAT(message_of<InputError>([&] {
                Mast(MastOptions{}).clamped({1e17, 0.0, 0.3}, warnings);
              }),
              AllOf(HasSubstr("pan is 1e+17 rad"), HasSubstr("within 10000 rad")))
      << "a search that adds to it would change nothing";
  EXPECT_THROW(
      Mast(MastOptions{}).clamped({std::numeric_limits<double>::infinity(), 0, 0.3}, warnings),
      InputError);
}

TEST(MastOptions, BadFieldsAreNamedWithTheirValue) {
  const auto message = [](auto spoil) {
    MastOptions options;
    spoil(options);
    return message_of<InputError>([&] { options.validate(); });
  };
  EXPECT_EQ(message([](auto&) {}), "");
  EXPECT_THAT(message([](auto& m) { m.pan_min_rad = 4; }),
              HasSubstr("mast.pan_min_rad is 4, it must be at most mast.pan_max_rad"));
  EXPECT_THAT(message([](auto& m) { m.pan_max_rad = kNaN; }), HasSubstr("mast.pan_max_rad is nan"));
  EXPECT_THAT(message([](auto& m) { m.pan_velocity_rad_s = 0; }),
              HasSubstr("mast.pan_velocity_rad_s is 0"));
  EXPECT_THAT(message([](auto& m) { m.tilt_min_rad = -1.6; }),
              HasSubstr("mast.tilt_min_rad is -1.6"));
  EXPECT_THAT(message([](auto& m) { m.tilt_max_rad = 1.6; }),
              HasSubstr("mast.tilt_max_rad is 1.6"));
  EXPECT_THAT(message([](auto& m) { m.tilt_velocity_rad_s = -0.5; }),
              HasSubstr("mast.tilt_velocity_rad_s is -0.5"));
  EXPECT_THAT(message([](auto& m) { m.height_max_m = 0.1; }),
              HasSubstr("mast.height_min_m is 0.18, it must be at most mast.height_max_m, which "
                        "is 0.1"));
  EXPECT_THAT(message([](auto& m) { m.height_velocity_m_s = kNaN; }),
              HasSubstr("mast.height_velocity_m_s is nan"));
  EXPECT_THAT(message([](auto& m) { m.pan_axis_y_m = -101.0; }),
              HasSubstr("mast.pan_axis_y_m is -101, it must be within 100 m of 0"));
  EXPECT_THAT(message([](auto& m) { m.sensor_offset_m[1] = kNaN; }),
              HasSubstr("mast.sensor_offset_m is nan"));
}

}  // namespace
}  // namespace nbvopt
