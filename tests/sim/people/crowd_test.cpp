// Where people walk: Gazebo's cafe against an integration of its own, waypoints by hand.
#include "sim/people/crowd.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <random>

#include "sim/people/cafe_people.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

Eigen::Vector3d robot_far_away(double /*time_s*/) { return {100.0, 100.0, 0.0}; }

/// Drives past the tables.
Eigen::Vector3d robot_in_the_cafe(double time_s) { return {1.0, 1.0 - 0.2 * time_s, 0.19}; }

/// The cafe's two walkers as its specification tells them, in the plane's complex numbers with
/// heights beside.
class CafeIntegration {
 public:
  CafeIntegration(std::uint64_t seed, RobotPosition robot) : robot_(std::move(robot)) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      std::seed_seq words{seed, seed >> 32, i};
      walkers_[i].random.seed(words);
    }
  }

  void walk(int updates) {
    for (int i = 0; i < updates; ++i) {
      ++updates_;
      update(0);
      update(1);
    }
  }

  std::complex<double> at(int walker) const { return walkers_[walker].at; }
  int draws() const { return draws_; }

 private:
  using Point = std::complex<double>;
  struct Walker {
    Point at;
    double z;
    Point target;
    double target_z;
    double yaw = 0.0;
    std::mt19937_64 random = {};
  };

  template <class Visit>
  void for_each_other(int me, const Visit& visit) const {
    for (const Point table : {Point(0.5, -1.6), Point(2.4, -5.5), Point(-1.5, -5.5),
                              Point(2.4, -9.0), Point(-1.5, -9.0)}) {
      visit(table, 0.2);
    }
    visit(walkers_[1 - me].at, walkers_[1 - me].z);
    const Eigen::Vector3d robot = robot_(1e-3 * updates_);
    visit(Point(robot.x(), robot.y()), robot.z());
  }

  void draw_target(int me) {
    Walker& walker = walkers_[me];
    const auto draw = [&](double least, double width) {
      return least + width * (static_cast<double>(walker.random() / 2048) / 9007199254740992.0);
    };
    for (;;) {
      ++draws_;
      const double x = draw(-3.0, 6.5);
      const Point place(x, draw(-10.0, 12.0));
      if (std::abs(place - walker.target) < 2.0) continue;
      bool is_free = true;
      const auto keep_away = [&](Point other, double z) {
        is_free &= std::hypot(std::abs(place - other), walker.target_z - z) >= 2.0;
      };
      for_each_other(me, keep_away);
      keep_away(walker.at, walker.z);
      keep_away(0.0, 0.0);  // the cafe and the ground plane
      if (!is_free) continue;
      walker.target = place;
      return;
    }
  }

  void update(int me) {
    Walker& walker = walkers_[me];
    if (std::hypot(std::abs(walker.target - walker.at), walker.target_z - walker.z) < 0.3) {
      draw_target(me);
    }
    const double way = std::hypot(std::abs(walker.target - walker.at), walker.target_z - walker.z);
    Point p = 1.15 / way * (walker.target - walker.at);
    for_each_other(me, [&](Point other, double z) {
      const double distance = std::hypot(std::abs(other - walker.at), z - walker.z);
      if (distance < 4.0) p -= 1.8 / distance * (other - walker.at) / distance;
    });
    const double error = std::arg(std::polar(1.0, std::arg(p) + 1.5707 - walker.yaw));
    if (std::abs(error) > 10.0 * kPi / 180.0) {
      walker.yaw += 0.001 * error;
    } else {
      walker.yaw += error;
      walker.at += 0.8 * 0.001 * p;
    }
    walker.at = {std::min(3.5, std::max(-3.0, walker.at.real())),
                 std::min(2.0, std::max(-10.0, walker.at.imag()))};
    walker.z = 1.2138;
  }

  RobotPosition robot_;
  std::array<Walker, 2> walkers_{Walker{{0.0, 1.0}, 1.25, {0.0, -5.0}, 1.2138},
                                 Walker{{-2.0, -2.0}, 1.25, {3.0, 2.0}, 1.24}};
  int updates_ = 0;
  int draws_ = 0;
};

TEST(Crowd, WalksThroughTheCafeAsAnIntegrationOfItsOwn) {
  for (const RobotPosition& robot :
       {RobotPosition(robot_far_away), RobotPosition(robot_in_the_cafe)}) {
    Crowd crowd(cafe_people(), 7);
    CafeIntegration expected(7, robot);
    double farthest_m = 0.0;
    for (int second = 1; second <= 60; ++second) {
      crowd.walk_until(second, robot);
      expected.walk(1000);
      for (int i = 0; i < 2; ++i) {
        const Eigen::Vector3d& position = crowd.poses()[i].position_map_m;
        ASSERT_NEAR(position.x(), expected.at(i).real(), 1e-6) << second << " s, walker " << i;
        ASSERT_NEAR(position.y(), expected.at(i).imag(), 1e-6) << second << " s, walker " << i;
        EXPECT_EQ(position.z(), 1.2138);
      }
      farthest_m = std::max(farthest_m, std::abs(expected.at(0) - std::complex<double>(0.0, 1.0)));
    }
    EXPECT_GT(farthest_m, 3.0);
    EXPECT_GT(expected.draws(), 2);
    EXPECT_GT(crowd.poses()[0].walked_m, 10.0);
  }
}

TEST(Crowd, DoesNotDependOnWhenItIsAsked) {
  Crowd often(cafe_people(), 3);
  Crowd seldom(cafe_people(), 3);
  for (int i = 1; i <= 600; ++i) often.walk_until(0.1 * i, robot_in_the_cafe);
  seldom.walk_until(60.0, robot_in_the_cafe);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(often.poses()[i].position_map_m, seldom.poses()[i].position_map_m);
    EXPECT_EQ(often.poses()[i].walked_m, seldom.poses()[i].walked_m);
  }
  Crowd other_seed(cafe_people(), 4);
  other_seed.walk_until(60.0, robot_in_the_cafe);
  EXPECT_NE(other_seed.poses()[0].position_map_m, seldom.poses()[0].position_map_m);
}

TEST(Crowd, StaysWhereThereIsNoOtherTarget) {
  People people = cafe_people();
  for (double x = -3.0; x <= 3.5; x += 1.0) {
    for (double y = -10.0; y <= 2.0; y += 1.0) people.models.push_back({"crate", {x, y, 1.2138}});
  }
  Crowd crowd(people, 1);
  crowd.walk_until(5.0, robot_far_away);  // and does not seek without end
  EXPECT_TRUE(crowd.poses()[0].position_map_m.allFinite());
}

Crowd scripted(const ScriptedWalk& walk) {
  return Crowd({.persons = {{.name = "a", .position_map_m = {9.0, 9.0, 1.0}, .walk = walk}}}, 1);
}

/// x, y and yaw at a time.
Eigen::Vector3d pose_at(const ScriptedWalk& walk, double time_s) {
  Crowd crowd = scripted(walk);
  crowd.walk_until(time_s, robot_far_away);
  const WalkerPose& pose = crowd.poses()[0];
  return {pose.position_map_m.x(), pose.position_map_m.y(), pose.heading_rad};
}

ScriptedWalk there_and_round_the_corner() {
  return {.waypoints = {{0.0, {0.0, 0.0, 1.0}, 0.0},
                        {2.0, {4.0, 0.0, 1.0}, 0.0},
                        {3.0, {4.0, 0.0, 1.0}, kPi / 2},
                        {5.0, {4.0, 1.0, 1.0}, kPi / 2}}};
}

void expect_near(const Eigen::Vector3d& pose, const Eigen::Vector3d& expected) {
  EXPECT_LT((pose - expected).norm(), 1e-9)
      << pose.transpose() << " is not " << expected.transpose();
}

TEST(Crowd, InterpolatesWaypointsInTime) {
  const ScriptedWalk walk = there_and_round_the_corner();
  expect_near(pose_at(walk, 0.0), {0.0, 0.0, 0.0});
  expect_near(pose_at(walk, 0.5), {1.0, 0.0, 0.0});
  expect_near(pose_at(walk, 2.5), {4.0, 0.0, kPi / 4});
  expect_near(pose_at(walk, 4.0), {4.0, 0.5, kPi / 2});
  expect_near(pose_at(walk, 5.5), {1.0, 0.0, 0.0});
  Crowd crowd = scripted(walk);
  crowd.walk_until(5.5, robot_far_away);
  EXPECT_NEAR(crowd.poses()[0].walked_m, 6.0, 1e-9);
}

TEST(Crowd, TurnsTheShortWayRound) {
  const ScriptedWalk walk{.waypoints = {{0.0, {0.0, 0.0, 0.0}, 3.0}, {1.0, {0.0, 0.0, 0.0}, -3.0}}};
  EXPECT_NEAR(pose_at(walk, 0.5).z(), kPi, 1e-9);
}

TEST(Crowd, WaitsBeforeEachRound) {
  ScriptedWalk walk = there_and_round_the_corner();
  walk.delay_s = 1.0;
  expect_near(pose_at(walk, 0.5), {9.0, 9.0, 0.0});  // where the world has him
  expect_near(pose_at(walk, 1.5), {1.0, 0.0, 0.0});
  expect_near(pose_at(walk, 6.5), {4.0, 1.0, kPi / 2});  // where the last round ended
  expect_near(pose_at(walk, 7.5), {1.0, 0.0, 0.0});
}

TEST(Crowd, EndsWithoutALoopAndNeedsAStart) {
  ScriptedWalk walk = there_and_round_the_corner();
  walk.is_loop = false;
  expect_near(pose_at(walk, 50.0), {4.0, 1.0, kPi / 2});
  walk.starts_itself = false;
  expect_near(pose_at(walk, 2.0), {9.0, 9.0, 0.0});
}

TEST(Crowd, StandsAtASingleWaypoint) {
  const ScriptedWalk walk{.waypoints = {{0.0, {1.0, 2.0, 0.0}, 0.5}}};
  expect_near(pose_at(walk, 3.0), {1.0, 2.0, 0.5});
}

}  // namespace
}  // namespace nbvopt::test
