#include "sim/exploration/base_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nbvopt {
namespace {

constexpr double kStep_s = 0.05;

struct Sample {
  Eigen::Vector2d position_m;
  double yaw_rad;
};

/// Steps until the base stands at the path's end; fails when it takes too long.
std::vector<Sample> drive(BaseMotion& base) {
  std::vector<Sample> samples{{base.position_map_m(), base.yaw_rad()}};
  const auto sample = [&] {
    base.step(kStep_s);
    samples.push_back({base.position_map_m(), base.yaw_rad()});
  };
  for (int i = 0; i < 20000 && !base.has_arrived(); ++i) sample();
  EXPECT_TRUE(base.has_arrived());
  base.halt();
  for (int i = 0; i < 200 && !base.stands(); ++i) sample();
  EXPECT_TRUE(base.stands());
  return samples;
}

void expect_within_limits(const std::vector<Sample>& samples, const BaseOptions& options) {
  constexpr double kRounding = 1e-9;
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
  double turn_rate_rad_s = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Eigen::Vector2d next_m_s = (samples[i].position_m - samples[i - 1].position_m) / kStep_s;
    const double next_rad_s = (samples[i].yaw_rad - samples[i - 1].yaw_rad) / kStep_s;
    ASSERT_LE(next_m_s.norm(), options.speed_max_m_s + kRounding);
    ASSERT_LE((next_m_s - velocity_m_s).norm() / kStep_s,
              options.acceleration_max_m_s2 + kRounding);
    ASSERT_LE(std::abs(next_rad_s), options.turn_rate_max_rad_s + kRounding);
    ASSERT_LE(std::abs(next_rad_s - turn_rate_rad_s) / kStep_s,
              options.turn_acceleration_max_rad_s2 + kRounding);
    velocity_m_s = next_m_s;
    turn_rate_rad_s = next_rad_s;
  }
}

TEST(BrakingSpeed, StopsWithinTheDistanceStepByStep) {
  for (const double distance_m : {0.0, 1e-4, 0.01, 0.0625, 0.3, 2.0}) {
    double left_m = distance_m;
    double speed_m_s = braking_speed(left_m, 0.5, kStep_s);
    for (int i = 0; i < 200; ++i) {
      left_m -= speed_m_s * kStep_s;
      const double next_m_s = braking_speed(std::max(left_m, 0.0), 0.5, kStep_s);
      EXPECT_LE(speed_m_s - next_m_s, 0.5 * kStep_s + 1e-9);
      speed_m_s = next_m_s;
    }
    EXPECT_NEAR(left_m, 0.0, 1e-6);
  }
}

TEST(BaseMotion, DrivesAStraightLineInTheTimeThatItsLimitsAllow) {
  const BaseOptions options;
  BaseMotion base(options, {0.0, 0.0}, 0.0);
  base.follow(Path({{0.0, 0.0}, {2.0, 0.0}}));
  const std::vector<Sample> samples = drive(base);
  expect_within_limits(samples, options);
  // 2 m at 0.25 m/s and half a second each to speed up and to brake.
  EXPECT_NEAR(static_cast<double>(samples.size() - 1) * kStep_s, 8.5, 0.5);
  EXPECT_NEAR(base.position_map_m().x(), 2.0, 0.04);
  EXPECT_NEAR(base.position_map_m().y(), 0.0, 1e-9);
}

TEST(BaseMotion, KeepsItsLimitsAndItsPathRoundCorners) {
  const BaseOptions options;
  const Path path({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.2, 1.0}, {1.5, 1.2}, {1.5, 1.25}});
  BaseMotion base(options, {0.0, 0.0}, 2.0);
  base.follow(path);
  const std::vector<Sample> samples = drive(base);
  expect_within_limits(samples, options);
  for (const Sample& sample : samples) {
    const double along_m = path.nearest_m(sample.position_m, 0.0, path.length_m());
    EXPECT_LT((path.point_at(along_m) - sample.position_m).norm(), 0.035);
  }
}

TEST(BaseMotion, LooksWhereItDrives) {
  BaseMotion base({}, {0.0, 0.0}, 0.0);
  base.follow(Path({{0.0, 0.0}, {-2.0, 0.0}}));
  const std::vector<Sample> samples = drive(base);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Eigen::Vector2d way_m = samples[i].position_m - samples[i - 1].position_m;
    const Eigen::Vector2d forward(std::cos(samples[i].yaw_rad), std::sin(samples[i].yaw_rad));
    EXPECT_GE(way_m.dot(forward), -1e-9) << "never backwards";
  }
  EXPECT_NEAR(std::abs(samples.back().yaw_rad), std::numbers::pi, 0.05);
}

TEST(BaseMotion, TurnsRoundWhenItsPathDoes) {
  const BaseOptions options;
  BaseMotion base(options, {0.0, 0.0}, 0.0);
  base.follow(Path({{0.0, 0.0}, {5.0, 0.0}}));
  std::vector<Sample> samples{{base.position_map_m(), base.yaw_rad()}};
  for (int i = 0; i < 100; ++i) {
    base.step(kStep_s);
    samples.push_back({base.position_map_m(), base.yaw_rad()});
  }
  base.follow(Path({base.position_map_m(), {0.0, 0.5}}));
  const std::vector<Sample> back = drive(base);
  samples.insert(samples.end(), back.begin() + 1, back.end());
  expect_within_limits(samples, options);
  EXPECT_LT((base.position_map_m() - Eigen::Vector2d(0.0, 0.5)).norm(), 0.05);
}

TEST(BaseMotion, StandsWithoutAPath) {
  BaseMotion base({}, {1.0, 2.0}, 0.5);
  base.step(kStep_s);
  EXPECT_TRUE(base.stands());
  EXPECT_TRUE(base.has_arrived());
  EXPECT_EQ(base.position_map_m(), Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(base.yaw_rad(), 0.5);
}

TEST(BaseMotion, TurnsOnTheSpot) {
  for (const double yaw_rad : {1.0, -2.5, 7.0}) {
    BaseMotion base({}, {1.0, 2.0}, 0.5);
    base.turn_to(yaw_rad);
    std::vector<Sample> samples{{base.position_map_m(), base.yaw_rad()}};
    for (int i = 0; i < 2000 && !(base.has_turned() && base.stands()); ++i) {
      base.step(kStep_s);
      samples.push_back({base.position_map_m(), base.yaw_rad()});
    }
    EXPECT_NEAR(base.yaw_rad(), yaw_rad, 0.01);
    EXPECT_EQ(base.position_map_m(), Eigen::Vector2d(1.0, 2.0));
    expect_within_limits(samples, {});
  }
}

}  // namespace
}  // namespace nbvopt
