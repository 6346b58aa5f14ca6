// The errors of wheels against GMapping's formulas.
#include "sim/odometry/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/normal.hpp"

namespace nbvopt::test {
namespace {

/// Mean and standard deviation, number by number.
struct Spread {
  Eigen::Vector3d mean;
  Eigen::Vector3d deviation;
};

Spread spread_of(const std::vector<Eigen::Vector3d>& samples) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_of_squares = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& sample : samples) {
    sum += sample;
    sum_of_squares += sample.cwiseAbs2();
  }
  const auto n = static_cast<double>(samples.size());
  return {sum / n, (sum_of_squares / n - (sum / n).cwiseAbs2()).cwiseSqrt()};
}

TEST(StandardNormal, HasTheMomentsOfANormalNumber) {
  std::mt19937_64 generator(1);
  constexpr int kCount = 100'000;
  std::vector<double> moments(5, 0.0);
  for (int i = 0; i < kCount; ++i) {
    const double number = standard_normal(generator);
    double power = 1.0;
    for (double& moment : moments) {
      moment += power / kCount;
      power *= number;
    }
  }
  EXPECT_NEAR(moments[1], 0.0, 0.015);
  EXPECT_NEAR(moments[2], 1.0, 0.02);
  EXPECT_NEAR(moments[3], 0.0, 0.05);
  EXPECT_NEAR(moments[4], 3.0, 0.12);
}

TEST(MotionModel, DeviatesByTheFormulas) {
  // x: 0.1 |dx| + 0.1 |dth| + 0.03 |dy|; yaw: 0.2 |dth| + 0.2 hypot(dx, dy).
  const Eigen::Vector3d deviations = MotionModel(1.0).deviations({0.3, -0.4, -0.5});
  EXPECT_NEAR(deviations.x(), 0.03 + 0.05 + 0.012, 1e-12);
  EXPECT_NEAR(deviations.y(), 0.04 + 0.05 + 0.009, 1e-12);
  EXPECT_NEAR(deviations.z(), 0.1 + 0.1, 1e-12);
  EXPECT_TRUE(MotionModel(0.5).deviations({0.3, -0.4, -0.5}).isApprox(0.5 * deviations, 1e-12));
  EXPECT_TRUE(MotionModel(1.0).deviations({}).isZero(0.0)) << "a base that stands knows it";
}

TEST(MotionModel, ErrsByItsDeviations) {
  const PlanarPose motion{0.4, 0.1, 0.2};
  const MotionModel model(1.0);
  std::mt19937_64 generator(2);
  std::vector<Eigen::Vector3d> errors;
  for (int i = 0; i < 20'000; ++i) {
    Eigen::Vector3d normals;
    for (double& normal : normals) normal = standard_normal(generator);
    const PlanarPose erring = model.erring(motion, normals);
    errors.emplace_back(erring.x_m - motion.x_m, erring.y_m - motion.y_m,
                        erring.yaw_rad - motion.yaw_rad);
  }
  const Spread spread = spread_of(errors);
  EXPECT_TRUE(spread.mean.isZero(0.003)) << spread.mean.transpose();
  EXPECT_TRUE(spread.deviation.isApprox(model.deviations(motion), 0.02));
}

/// Ahead at a speed, turning at a rate.
Trajectory arc(double speed_m_s, double turn_rad_s, double duration_s) {
  std::vector<TrajectoryPoint> points;
  PlanarPose pose{1.0, -2.0, 0.3};
  double yaw_rad = pose.yaw_rad;
  for (int i = 0; i * 0.05 <= duration_s + 1e-9; ++i) {
    points.push_back({i * 0.05, pose.x_m, pose.y_m, 0.1, yaw_rad});
    pose = pose * PlanarPose{0.05 * speed_m_s, 0.0, 0.05 * turn_rad_s};
    yaw_rad += 0.05 * turn_rad_s;
  }
  return Trajectory(points);
}

TEST(Odometry, StepsByLengthTurnOrTime) {
  const auto second_step_s = [](double speed_m_s, double turn_rad_s) {
    const Trajectory drive = arc(speed_m_s, turn_rad_s, 6.0);
    return Odometry(drive, MotionModel(1.0), 1).steps()[1].begin_s;
  };
  EXPECT_NEAR(second_step_s(0.1, 0.0), 2.0, 1e-9) << "two seconds";
  EXPECT_NEAR(second_step_s(1.1, 0.0), 1.0, 1e-9) << "a metre";
  EXPECT_NEAR(second_step_s(0.0, 0.7), 0.8, 1e-9) << "half a radian, at the next scan";
  EXPECT_NEAR(second_step_s(0.0, 0.0), 2.0, 1e-9);
}

TEST(Odometry, IsTheTruthWithoutNoise) {
  const Trajectory drive = arc(0.25, 0.3, 20.0);
  const Odometry odometry(drive, MotionModel(0.0), 1);
  for (int i = 0; i < 55; ++i) {
    const double time_s = 0.37 * i;
    const PlanarPose T_world_base = planar_pose(drive.T_map_base(time_s));
    const PlanarPose off = inverse(T_world_base) * odometry.T_odom_base(time_s);
    EXPECT_NEAR(off.x_m, 0.0, 1e-9);
    EXPECT_NEAR(off.y_m, 0.0, 1e-9);
    EXPECT_NEAR(off.yaw_rad, 0.0, 1e-9);
  }
}

TEST(Odometry, ErrsAStepByTheModelAndRunsOnWithoutJumps) {
  const Trajectory drive = arc(0.25, 0.0, 4.0);
  std::vector<Eigen::Vector3d> errors;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const Odometry odometry(drive, MotionModel(1.0), seed);
    const PlanarPose start = odometry.steps()[0].T_odom_base;
    const PlanarPose after = odometry.steps()[1].T_odom_base;
    const PlanarPose motion = inverse(start) * after;
    errors.emplace_back(motion.x_m - 0.5, motion.y_m, motion.yaw_rad);
    const PlanarPose before = odometry.T_odom_base(2.0 - 1e-7);
    ASSERT_NEAR(before.x_m, after.x_m, 1e-6);
    ASSERT_NEAR(before.yaw_rad, after.yaw_rad, 1e-6);
  }
  const Spread spread = spread_of(errors);
  EXPECT_TRUE(spread.mean.isZero(0.006)) << spread.mean.transpose();
  EXPECT_TRUE(spread.deviation.isApprox(MotionModel(1.0).deviations({0.5, 0.0, 0.0}), 0.04))
      << spread.deviation.transpose();
}

TEST(Odometry, IsTheSamePerSeed) {
  const Trajectory drive = arc(0.25, 0.3, 20.0);
  const auto end = [&](std::uint64_t seed) {
    return Odometry(drive, MotionModel(1.0), seed).T_odom_base(20.0);
  };
  EXPECT_EQ(end(3), end(3));
  EXPECT_NE(end(3), end(4));
}

}  // namespace
}  // namespace nbvopt::test
