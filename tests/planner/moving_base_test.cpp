// Plans of a base that drives on while the joints move.
#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "nbvopt/core/error.hpp"
#include "planner/planner_world.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PlanRequest driving_request(const BaseTwist& base_twist, double motion_time_s = 1.0) {
  PlanRequest request = request_at(kMiddle, motion_time_s);
  request.base_twist = base_twist;
  return request;
}

/// A gain that grows with how far the camera has come along map x.
double gain_ahead(const Transform& T_map_sensor) { return 10.0 + T_map_sensor.translation().x(); }

TEST(MovingBase, IsJudgedWhereItWillBe) {
  const World world(free_cube(), gain_ahead);
  const PlanRequest request = driving_request({0.5, 0.0, 0.0});
  const PlanResult result = world.planner().plan(request, *pan_grid(0.5));
  expect_contract(world, request, result);
  EXPECT_NEAR(std::abs(result.joints.pan_rad), kPi, 1e-9) << "the longest move drives farthest";
  EXPECT_NEAR(result.view.gain, 10.0 + 0.03 + 0.5, 1e-9);
  EXPECT_NEAR(result.T_map_base.translation().x(), 0.03 + 0.5, 1e-9);
  EXPECT_EQ(result.current.gain, 10.0 + 0.03) << "staying is the pose now";
}

TEST(MovingBase, StaysRatherThanDriveAwayFromTheGain) {
  const World world(free_cube(), gain_ahead);
  const PlanRequest request = driving_request({-0.5, 0.0, 0.0});
  const PlanResult result = world.planner().plan(request, *pan_grid(0.5));
  expect_contract(world, request, result);
  EXPECT_EQ(result.joints, request.joints);
  EXPECT_EQ(result.move_time_s, 0.0);
  EXPECT_EQ(result.T_map_base.matrix(), request.T_map_base.matrix());
}

TEST(MovingBase, DiffersFromOneAtRestAsPredicted) {
  const World world(free_cube(), 3.0);
  const PlanRequest at_rest = request_at(kMiddle, 1.0);
  const PlanRequest moving = driving_request({0.6, 0.2, 0.4});
  const auto grid = make_solver("grid", {.grid_steps = {0.4, 0.25, 0.05}});
  const PlanResult result = world.planner().plan(moving, *grid);
  expect_contract(world, moving, result);
  EXPECT_GT(result.move_time_s, 0.0);
  // The same view is had by a robot that rests where this one will be.
  PlanRequest there = at_rest;
  there.T_map_base = result.T_map_base;
  const ViewGain from_there = world.view(there, result.joints);
  EXPECT_NEAR(from_there.gain, result.view.gain, 1e-9 * result.view.gain);
  EXPECT_NE(world.view(at_rest, result.joints).gain, result.view.gain);
}

/// A request whose base is 1 m ahead after a second and turned to the left after two.
PlanRequest path_request(double motion_time_s) {
  PlanRequest request = request_at(kMiddle, motion_time_s);
  const Transform ahead = request.T_map_base * base_pose(1.0, 0.0, 0.0, 0.0);
  request.base_path = {
      {0.0, request.T_map_base}, {1.0, ahead}, {2.0, ahead * base_pose(0.0, 0.0, 0.0, 0.5 * kPi)}};
  return request;
}

TEST(MovingBase, FollowsItsPathUntilTheViewIsTaken) {
  const Transform start = request_at(kMiddle, 1.0).T_map_base;
  const auto expect_at = [&](double motion_time_s, const Transform& from_start) {
    EXPECT_TRUE(T_map_base_on_path(path_request(motion_time_s)).isApprox(start * from_start, 1e-12))
        << motion_time_s;
  };
  expect_at(0.25, base_pose(0.25, 0.0, 0.0, 0.0));
  expect_at(1.0, base_pose(1.0, 0.0, 0.0, 0.0));
  expect_at(1.5, base_pose(1.0, 0.0, 0.0, 0.25 * kPi));
  expect_at(9.0, base_pose(1.0, 0.0, 0.0, 0.5 * kPi));
  PlanRequest later = path_request(0.5);
  later.base_path.erase(later.base_path.begin());
  EXPECT_TRUE(T_map_base_on_path(later).isApprox(start * base_pose(0.5, 0.0, 0.0, 0.0), 1e-12))
      << "it comes from where it is";
}

TEST(MovingBase, IsJudgedWhereItsPathLeads) {
  const World world(free_cube(), 3.0);
  const PlanRequest request = path_request(0.5);
  const auto grid = make_solver("grid", {.grid_steps = {0.4, 0.25, 0.05}});
  const PlanResult result = world.planner().plan(request, *grid);
  PlanRequest there = request;
  there.T_map_base = T_map_base_on_path(request);
  there.base_path.clear();
  const PlanResult from_there = world.planner().plan(there, *grid);
  EXPECT_EQ(result.joints, from_there.joints);
  EXPECT_EQ(result.view.gain, from_there.view.gain);
  EXPECT_EQ(result.T_map_base.matrix(), there.T_map_base.matrix());
  EXPECT_EQ(result.current.gain, from_there.current.gain) << "staying moves with the base";
}

TEST(MovingBase, RefusesPathsThatLeadNowhere) {
  const World world(free_cube(), 3.0);
  const auto message = [&](const auto& spoil) {
    PlanRequest request = path_request(0.5);
    spoil(request);
    return message_of<InputError>([&] { world.planner().plan(request, *pan_grid(0.5)); });
  };
  EXPECT_THAT(message([](auto& r) { r.base_twist.vx_m_s = 0.1; }), HasSubstr("leave base_twist"));
  EXPECT_THAT(message([](auto& r) { r.motion_time_s = 0.0; }), HasSubstr("needs a motion_time_s"));
  EXPECT_THAT(message([](auto& r) { r.base_path[2].time_s = 1.0; }),
              HasSubstr("base_path[2].time_s is 1 s, times must rise"));
  EXPECT_THAT(message([](auto& r) { r.base_path[0].time_s = -1.0; }),
              HasSubstr("base_path[0].time_s is -1 s"));
  EXPECT_THAT(message([](auto& r) { r.base_path[1].T_map_base(0, 3) = kNaN; }),
              HasSubstr("base_path[1]: every number"));
}

TEST(MovingBase, IsNeverWorseThanStaying) {
  const World world(free_cube([](UncertaintyMap& map) {
                      set_box(map, cube(key_from_origin(8, -20, -20), 4), occupied(0.9F));
                    }),
                    3.0);
  std::mt19937_64 random(3);
  for (int i = 0; i < 50; ++i) {
    PlanRequest request = driving_request(
        {uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, -2.0, 2.0)},
        uniform(random, 0.05, 2.0));
    request.stop.max_evaluations = 100;
    for (const char* solver : {"random", "auto"}) {
      expect_contract(world, request, world.planner().plan(request, *make_solver(solver, {})));
    }
  }
}

TEST(MovingBase, ReachesEveryVoxelThatAViewCanTouchOnItsWay) {
  const World world(free_cube());
  std::mt19937_64 random(9);
  for (const BaseTwist& twist : {BaseTwist{0.8, 0.0, 0.0}, BaseTwist{0.6, -0.3, 1.5}}) {
    expect_views_within_reach(world, driving_request(twist, 0.0), random);
  }
}

/// One wall voxel a metre ahead, 0.15 m above the camera: met by a camera that goes up while the
/// base drives towards it, and by none that rises on the spot.
TEST(MovingBase, EndsTheMastsWayWhereTheDriveMeetsAnObstacle) {
  const World world(free_cube([](UncertaintyMap& map) {
    map.set(map.lattice().key({1.03, 0.02, 0.56}), occupied(1.0F));
  }));
  EXPECT_EQ(world.planner().reachable_box(driving_request({0.0, 0.0, 0.0}, 0.0)).max[2], 0.63);
  const JointBox box = world.planner().reachable_box(driving_request({1.0, 0.0, 0.0}, 0.0));
  EXPECT_LT(box.max[2], 0.56);
  EXPECT_GT(box.max[2], 0.53);
  EXPECT_EQ(box.min[2], 0.18);
}

TEST(MovingBase, PassesNoObstacleByLargeSteps) {
  // At 9 m/s, half a voxel of height takes three metres.
  const World world(free_cube([](UncertaintyMap& map) {
    map.set(map.lattice().key({1.03, 0.02, 0.41}), occupied(1.0F));
  }));
  EXPECT_LT(world.planner().reachable_box(driving_request({9.0, 0.0, 0.0}, 0.0)).max[2], 0.42);
}

}  // namespace
}  // namespace nbvopt::test
