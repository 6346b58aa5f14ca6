#include "nbvopt/mast/moving_mast.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nbvopt {
namespace {

using std::numbers::pi;

const JointPosition kNow{0.3, -0.2, 0.4};
const BaseTwist kArc{0.4, -0.1, 0.7};

Mast mast_with_lever() {
  MastOptions options;
  options.sensor_offset_m = {0.06, -0.02, 0.03};
  return Mast(options);
}

/// The same whose pan axis stands beside the base's origin.
Mast mast_beside() {
  MastOptions options = mast_with_lever().options();
  options.pan_axis_x_m = -0.1;
  options.pan_axis_y_m = 0.07;
  return Mast(options);
}

/// A base on a slope: nothing may rely on its z being the map's.
Transform tilted_base() {
  Transform T_map_base = base_pose(1.0, -2.0, 0.1, 0.8);
  T_map_base.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  return T_map_base;
}

/// Positions that are away from the kinks of the slowest joint's time, each with another slowest
/// joint or direction.
std::vector<JointPosition> positions() {
  return {{1.5, -0.1, 0.42}, {-1.1, 0.0, 0.38}, {0.5, 0.3, 0.45},  {0.2, -0.7, 0.41},
          {0.5, -0.1, 0.6},  {0.1, -0.3, 0.2},  {3.2, 0.75, 0.40}, {0.31, 0.1, 0.39}};
}

TEST(MovingMast, AtRestIsTheMastOnItsBase) {
  const Mast mast = mast_with_lever();
  const MovingMast at_rest(mast, tilted_base(), BaseTwist{}, kNow);
  for (const JointPosition& q : positions()) {
    EXPECT_EQ(at_rest.T_map_sensor(q).matrix(), (tilted_base() * mast.T_base_sensor(q)).matrix());
  }
  EXPECT_EQ(at_rest.T_map_base(5.0).matrix(), tilted_base().matrix());
}

TEST(MovingMast, CarriesAMastBesideItsOrigin) {
  const Mast mast = mast_beside();
  const MovingMast moving(mast, tilted_base(), kArc, kNow);
  const MovingMast base(mast_with_lever(), tilted_base(), kArc, kNow);
  for (const JointPosition& q : positions()) {
    const double time_s = moving.arrival_time_s(q);
    EXPECT_TRUE(moving.T_map_base(time_s).isApprox(base.T_map_base(time_s), 1e-12));
    EXPECT_TRUE(
        moving.T_map_sensor(q).isApprox(base.T_map_base(time_s) * mast.T_base_sensor(q), 1e-12));
  }
}

TEST(MovingMast, StandsWhereItIsUntilTheJointsMove) {
  const Mast mast = mast_with_lever();
  const MovingMast moving(mast, tilted_base(), kArc, kNow);
  EXPECT_TRUE(moving.T_map_sensor(kNow).isApprox(tilted_base() * mast.T_base_sensor(kNow), 1e-15));
}

TEST(MovingMast, CarriesTheCameraAlongUntilTheSlowestJointArrives) {
  const Mast mast = mast_with_lever();
  const MovingMast moving(mast, base_pose(1.0, 2.0, 0.0, pi / 2), {0.5, 0.0, 0.0}, kNow);
  const JointPosition q{0.3, -0.2, 0.55};  // one second of the height's 0.15 m/s
  EXPECT_NEAR(moving.arrival_time_s(q), 1.0, 1e-12);
  const Transform expected = base_pose(1.0, 2.5, 0.0, pi / 2) * mast.T_base_sensor(q);
  EXPECT_TRUE(moving.T_map_sensor(q).isApprox(expected, 1e-12));
}

TEST(MovingMast, DrivesTheArcThatSmallStepsSum) {
  const MovingMast moving(Mast(MastOptions{}), tilted_base(), kArc, kNow);
  constexpr double kTime_s = 2.5;
  constexpr int kSteps = 200000;
  constexpr double kStep_s = kTime_s / kSteps;
  Eigen::Vector2d p_m = Eigen::Vector2d::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const double yaw_rad = kArc.wz_rad_s * (i + 0.5) * kStep_s;
    p_m += kStep_s * (Eigen::Rotation2Dd(yaw_rad) * Eigen::Vector2d(kArc.vx_m_s, kArc.vy_m_s));
  }
  const Transform expected =
      tilted_base() * base_pose(p_m.x(), p_m.y(), 0.0, kArc.wz_rad_s * kTime_s);
  EXPECT_TRUE(moving.T_map_base(kTime_s).isApprox(expected, 1e-9))
      << moving.T_map_base(kTime_s).matrix();
}

TEST(MovingMast, DrivesAHalfCircle) {
  const MovingMast moving(Mast(MastOptions{}), Transform::Identity(), {1.0, 0.0, 1.0}, kNow);
  const Transform end = moving.T_map_base(pi);
  EXPECT_LT((end.translation() - Eigen::Vector3d(0.0, 2.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(end.linear()(0, 0), -1.0, 1e-12);
}

TEST(MovingMast, DrivesStraightAsTheTurnVanishes) {
  const auto base_after = [](double wz_rad_s) {
    return MovingMast(Mast(MastOptions{}), tilted_base(), {0.4, -0.1, wz_rad_s}, kNow)
        .T_map_base(2.0);
  };
  const Transform straight = base_after(0.0);
  for (const double wz_rad_s : {1e-6, 1e-9, 1e-12, 1e-100, 1e-310}) {
    EXPECT_TRUE(base_after(wz_rad_s).isApprox(straight, 2.0 * wz_rad_s + 1e-15)) << wz_rad_s;
    EXPECT_TRUE(base_after(-wz_rad_s).isApprox(straight, 2.0 * wz_rad_s + 1e-15)) << wz_rad_s;
  }
}

TEST(MovingMast, ArrivesAsLateAsItsSlowestJoint) {
  constexpr double kStep = 1e-6;
  const MovingMast moving(mast_with_lever(), tilted_base(), kArc, kNow);
  for (const JointPosition& q : positions()) {
    const Eigen::Vector3d gradient_s = moving.arrival_time_gradient(q);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      const double before_s = moving.arrival_time_s(JointPosition::from(q.vector() - step));
      const double after_s = moving.arrival_time_s(JointPosition::from(q.vector() + step));
      EXPECT_NEAR(gradient_s[i], (after_s - before_s) / (2.0 * kStep), 1e-8);
    }
  }
}

/// The velocity of SE(3) that takes one pose to a near one, in the frame of the poses.
struct Velocity {
  Eigen::Vector3d angular, linear;
};
Velocity log_of(const Transform& T_before_after) {
  const Eigen::AngleAxisd turn(T_before_after.linear());
  const Eigen::Vector3d angular = turn.angle() * turn.axis();
  // Half way along a small turn; what is left out is of its third order.
  return {angular,
          T_before_after.translation() - 0.5 * angular.cross(T_before_after.translation())};
}

void expect_motion_as_differences_say(const MovingMast& mast, const JointPosition& q) {
  constexpr double kStep = 1e-5;
  const SensorMotion motion = mast.sensor_motion(q);
  for (const Joint joint : kJoints) {
    const auto i = static_cast<std::size_t>(joint);
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i));
    const Transform before = mast.T_map_sensor(JointPosition::from(q.vector() - step));
    const Transform after = mast.T_map_sensor(JointPosition::from(q.vector() + step));
    const Velocity moved = log_of(before.inverse() * after);
    EXPECT_LT((motion.angular[i] - moved.angular / (2.0 * kStep)).norm(), 1e-8)
        << to_string(joint) << " at " << q.vector().transpose();
    EXPECT_LT((motion.linear[i] - moved.linear / (2.0 * kStep)).norm(), 1e-8)
        << to_string(joint) << " at " << q.vector().transpose();
  }
}

TEST(SensorMotion, IsTheDerivativeOfThePose) {
  for (const Mast& mast : {Mast(MastOptions{}), mast_with_lever(), mast_beside()}) {
    for (const BaseTwist& twist : {BaseTwist{}, kArc, BaseTwist{0.5, 0.2, 0.0}}) {
      const MovingMast moving(mast, tilted_base(), twist, kNow);
      for (const JointPosition& q : positions()) expect_motion_as_differences_say(moving, q);
    }
  }
}

TEST(MovingMast, IsSlowestToAFaceOfTheBox) {
  const Mast mast(MastOptions{});
  const MovingMast moving(mast, tilted_base(), kArc, kNow);
  const JointBox box{kNow.vector() - Eigen::Vector3d(0.4, 0.3, 0.0),
                     kNow.vector() + Eigen::Vector3d(0.5, 0.1, 0.15)};
  EXPECT_NEAR(moving.longest_arrival_time_s(box), 1.0, 1e-12) << "0.15 m up at 0.15 m/s";
  EXPECT_NEAR(moving.longest_arrival_time_s({box.min, kNow.vector()}), 0.6, 1e-12);
}

TEST(SensorMotion, IsFiniteWhereTheArrivalTimeHasItsKink) {
  const MovingMast moving(mast_with_lever(), tilted_base(), kArc, kNow);
  const SensorMotion motion = moving.sensor_motion(kNow);
  for (const Joint joint : kJoints) {
    const auto i = static_cast<std::size_t>(joint);
    EXPECT_TRUE(motion.angular[i].allFinite());
    EXPECT_TRUE(motion.linear[i].allFinite());
  }
}

}  // namespace
}  // namespace nbvopt
