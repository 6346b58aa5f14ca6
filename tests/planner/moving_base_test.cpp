// Plans of a base that drives on while the joints move.
#include <gmock/gmock.h>

#include <random>

#include "planner/planner_world.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

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
