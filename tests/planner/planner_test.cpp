// What every answer of the planner keeps.
#include "planner/planner.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "planner/planner_world.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Planner, KeepsItsPromisesOnRandomQueries) {
  const UncertaintyMap map = read_map(datasets_dir() / "office_partial.ot");
  const World world(map, 4.0);
  const Planner planner = world.planner();
  const auto grid = make_solver("grid", {.grid_steps = {0.6, 0.3, 0.15}});
  const auto by_chance = make_solver("random", {});
  std::mt19937_64 random(8);
  int moved = 0;
  for (int i = 0; i < 100; ++i) {
    PlanRequest request;
    request.T_map_base = base_pose(uniform(random, -0.5, 8.5), uniform(random, -0.5, 6.5), 0.0,
                                   uniform(random, -kPi, kPi));
    request.joints = {uniform(random, -7.0, 7.0), uniform(random, -0.79, 0.79),
                      uniform(random, 0.18, 0.63)};
    request.motion_time_s = i % 5 == 0 ? 0.0 : uniform(random, 0.01, 2.0);
    request.seed = random();
    request.stop.max_evaluations = 80;
    for (const Solver* solver : {grid.get(), by_chance.get()}) {
      SCOPED_TRACE(solver->name() + ", query " + std::to_string(i));
      const PlanResult result = planner.plan(request, *solver);
      expect_contract(world, request, result);
      EXPECT_EQ(result.solver, solver->name());
      EXPECT_LE(result.evaluations, 80);
      moved += result.joints != request.joints;
      if (i % 10 != 0) continue;
      const PlanResult again = planner.plan(request, *solver);
      EXPECT_EQ(again.joints, result.joints);
      EXPECT_EQ(again.view, result.view);
    }
  }
  EXPECT_GT(moved, 50);
}

TEST(Planner, FindsTheBestOfTheGrid) {
  const UncertaintyMap map = free_cube();
  const World world(map, [](double yaw, double, double) { return 100.0 + std::cos(yaw - 0.75); });
  const PlanRequest request = request_at(kMiddle, 1.0 / kPi);  // pan within 1 rad
  const PlanResult result = world.planner().plan(request, *pan_grid(0.25));
  expect_contract(world, request, result);
  EXPECT_EQ(result.status, PlanStatus::grid_complete);
  EXPECT_NEAR(result.joints.pan_rad, 0.75, 1e-12);
  EXPECT_EQ(result.joints.tilt_rad, 0.0);
  EXPECT_EQ(result.evaluations, 9) << "-1 to 1 rad; the current pose is among them";
  EXPECT_THAT(result.message, HasSubstr("move: gain 101"));
  EXPECT_THAT(result.active_bounds, IsEmpty());
}

TEST(Planner, NamesTheFacesThatTheAnswerLiesOn) {
  const UncertaintyMap map = free_cube();
  const World world(map,
                    [](double yaw, double pitch, double z) { return 100.0 + yaw - pitch + z; });
  const PlanRequest request = request_at(kMiddle, 0.5);
  const PlanResult result =
      world.planner().plan(request, *make_solver("grid", {.grid_steps = {0.5 * kPi, 0.25, 0.075}}));
  expect_contract(world, request, result);
  EXPECT_THAT(result.active_bounds, ElementsAre("pan_max", "tilt_min", "height_max"));
  const Eigen::Vector3d corner(result.box.max[0], result.box.min[1], result.box.max[2]);
  EXPECT_LT((result.joints.vector() - corner).norm(), 1e-12) << "the grid's steps are rounded";
}

/// The base looks along map x, the best view is a little across the seam at pi.
TEST(Planner, TurnsAcrossTheSeamOfPan) {
  const UncertaintyMap map = free_cube();
  const World world(map, [](double yaw, double, double) { return 100.0 + std::cos(yaw + 2.8); });
  const PlanRequest request = request_at({3.0, 0.0, 0.4}, 0.5);
  const PlanResult result = world.planner().plan(request, *pan_grid(0.05));
  expect_contract(world, request, result);
  EXPECT_NEAR(result.joints.pan_rad, 2.0 * kPi - 2.8, 0.026) << "unwrapped";
  EXPECT_NEAR(result.view.gain, 101.0, 1e-3);
  EXPECT_LT(result.move_time_s, 0.2);
}

TEST(Planner, HasNoLimitWithoutAMotionTime) {
  const World world(free_cube());
  const PlanRequest request = request_at({10.0, 0.5, 0.3}, 0.0);
  const JointBox box = world.planner().reachable_box(request);
  EXPECT_EQ(box.min, Eigen::Vector3d(10.0 - kPi, -0.79, 0.18));
  EXPECT_EQ(box.max, Eigen::Vector3d(10.0 + kPi, 0.79, 0.63));
}

TEST(Planner, StaysWhereThereIsNoTimeToMove) {
  const World world(UncertaintyMap(0.1));
  for (const double motion_time_s : {1e-300, 1e-20, 1e-9}) {
    const PlanRequest request = request_at({1.0, -0.3, 0.4}, motion_time_s);
    for (const char* name : {"grid", "random"}) {
      const PlanResult result =
          world.planner().plan(request, *make_solver(name, {.grid_steps = {0.8, 0.8, 0.8}}));
      expect_contract(world, request, result);
      EXPECT_NEAR((result.joints.vector() - request.joints.vector()).norm(), 0.0, 1e-8);
    }
  }
}

TEST(Planner, MovesNoFrozenJoint) {
  const UncertaintyMap map = free_cube();
  const World world(map, [](double yaw, double pitch, double z) { return 9.0 + yaw + pitch + z; });
  const PlanRequest request = request_at({0.1, 0.2, 0.3}, 1.0);
  const PlanResult result =
      world.planner().plan(request, *make_solver("grid", {.grid_steps = {0.0, 0.0, 0.05}}));
  expect_contract(world, request, result);
  EXPECT_EQ(result.joints.pan_rad, 0.1);
  EXPECT_EQ(result.joints.tilt_rad, 0.2);
  EXPECT_GT(result.joints.height_m, 0.4);
}

TEST(Planner, PrefersTheLeastMotionWhereViewsTie) {
  const UncertaintyMap nothing(0.1);
  const World all_views_equal(nothing);
  const PlanRequest request = request_at(kMiddle, 2.0);
  const auto grid = make_solver("grid", {.grid_steps = {0.5, 0.3, 0.1}});
  const PlanResult stays = all_views_equal.planner().plan(request, *grid);
  expect_contract(all_views_equal, request, stays);
  EXPECT_EQ(stays.joints, request.joints);
  EXPECT_EQ(stays.move_time_s, 0.0);
  EXPECT_EQ(stays.status, PlanStatus::grid_complete);
  EXPECT_THAT(stays.message, HasSubstr("stay: no evaluated view is better"));

  // As good everywhere but ahead: the first candidate away from it.
  const World step(nothing,
                   [](double yaw, double, double) { return std::abs(yaw) > 0.6 ? 50.0 : 10.0; });
  const PlanRequest quarter = request_at(kMiddle, 2.0 / kPi);  // pan within 2 rad
  const PlanResult moves = step.planner().plan(quarter, *pan_grid(0.25));
  EXPECT_NEAR(std::abs(moves.joints.pan_rad), 0.75, 1e-12);
}

/// The view that all is known from, and why.
void expect_no_gain(const World& world, const PlanRequest& request, const std::string& reason) {
  const PlanResult result = world.planner().plan(request, *pan_grid(0.5));
  expect_contract(world, request, result);
  EXPECT_EQ(result.status, PlanStatus::no_gain_in_reach);
  EXPECT_EQ(result.joints, request.joints);
  EXPECT_EQ(result.move_time_s, 0.0);
  EXPECT_THAT(result.message, HasSubstr(reason));
}

TEST(Planner, SaysWhyThereIsNoGain) {
  const PlanRequest request = request_at({0.3, 0.0, 0.4}, 0.5);
  expect_no_gain(World(free_cube()), request, "all rays end in free space");
  expect_no_gain(World(free_cube([](UncertaintyMap& map) {
                   // A shell half a metre and more from the camera, known to the last voxel.
                   for_each_key(cube(key_from_origin(-20, -20, -20), 40), [&](VoxelKey key) {
                     const double d_m =
                         (map.lattice().centre_m(key) - Eigen::Vector3d(0, 0, 0.4)).norm();
                     if (d_m > 0.7) map.set(key, occupied(0.0F));
                   });
                 })),
                 request, "is known well enough");
  expect_no_gain(World(free_cube([](UncertaintyMap& map) {
                   set_box(map, cube(key_from_origin(-2, -2, 0), 8), occupied(1.0F));
                 })),
                 request, "inside an obstacle");
}

TEST(Planner, StaysInsideAnObstacleWhateverThereIsToGain) {
  const World world(free_cube([](UncertaintyMap& map) {
                      map.set(map.lattice().key({0.03, 0.02, 0.45}), occupied(1.0F));
                    }),
                    [](double yaw, double, double) { return 500.0 + yaw; });
  const PlanRequest request = request_at(kMiddle, 0.0);
  for (const Search& search : {Search{}, Search{.solver = "grid", .grid_steps = {0.5, 0.5, 0.1}},
                               Search{.solver = "nlopt:direct-l"}}) {
    const PlanResult result = world.planner().plan(request, *make_solver(search));
    SCOPED_TRACE(search.solver.value_or("auto"));
    EXPECT_EQ(result.status, PlanStatus::no_gain_in_reach);
    EXPECT_EQ(result.message, "stay: the sensor is inside an obstacle");
    EXPECT_EQ(result.joints, request.joints);
    EXPECT_EQ(result.view.gain, 500.0);
  }
}

TEST(Planner, StaysForLessThanTheLeastGainAskedFor) {
  const UncertaintyMap map = free_cube();
  const World world(map, [](double yaw, double, double) { return 2.0 + std::cos(yaw - 0.5); });
  PlanRequest request = request_at(kMiddle, 0.5);
  request.min_gain = 3.5;
  expect_no_gain(world, request, "stay");
  request.min_gain = 2.5;
  EXPECT_EQ(world.planner().plan(request, *pan_grid(0.5)).status, PlanStatus::grid_complete);
}

/// The camera is at z = 0.41 where the height is 0.4: the base stands at 0.01.
class HeightBox : public ::testing::Test {
 protected:
  static JointBox box_with(const std::vector<double>& occupied_z_m, double height_m = 0.4) {
    const World world(free_cube([&](UncertaintyMap& map) {
      for (const double z_m : occupied_z_m) {
        map.set(map.lattice().key({0.03, 0.02, z_m}), occupied(1.0F));
      }
    }));
    const PlanRequest request = request_at({0.0, 0.0, height_m}, 0.0);
    return world.planner().reachable_box(request);
  }
};

TEST_F(HeightBox, IsWholeWhereNothingStands) {
  EXPECT_EQ(box_with({}).min[2], 0.18);
  EXPECT_EQ(box_with({}).max[2], 0.63);
}

TEST_F(HeightBox, IsNotCutByTheUnknown) {
  UncertaintyMap map(0.1);
  map.set(map.lattice().key({0.03, 0.02, 0.41}), kFree);
  map.finish_writing();
  const JointBox box = World(map).planner().reachable_box(request_at(kMiddle, 0.0));
  EXPECT_EQ(box.min[2], 0.18);
  EXPECT_EQ(box.max[2], 0.63);
}

TEST_F(HeightBox, EndsBelowACeiling) {
  const JointBox box = box_with({0.55});
  EXPECT_LT(box.max[2], 0.49);
  EXPECT_GE(box.max[2], 0.49 - 0.05) << "within half a voxel";
  EXPECT_EQ(box.min[2], 0.18);
}

TEST_F(HeightBox, EndsAboveATable) {
  const JointBox box = box_with({0.25});
  EXPECT_GE(box.min[2], 0.29);
  EXPECT_LE(box.min[2], 0.29 + 0.05);
  EXPECT_EQ(box.max[2], 0.63);
}

TEST_F(HeightBox, EndsAtBoth) {
  const JointBox box = box_with({0.25, 0.55});
  EXPECT_GE(box.min[2], 0.29);
  EXPECT_LT(box.max[2], 0.49);
}

TEST_F(HeightBox, SeesAnObstacleAtItsVeryEnd) {
  // The voxel from 0.6 to 0.7 begins 0.04 m below the mast's top, at 0.64.
  EXPECT_LT(box_with({0.65}).max[2], 0.59);
}

TEST_F(HeightBox, HoldsTheCameraInsideAnObstacle) {
  for (const auto& occupied_z_m : {std::vector{0.45}, {0.45, 0.55}, {0.35, 0.45}}) {
    const JointBox box = box_with(occupied_z_m);
    EXPECT_EQ(box.min[2], 0.4);
    EXPECT_EQ(box.max[2], 0.4);
  }
}

TEST_F(HeightBox, HoldsTheCurrentHeightBesideAnObstacle) {
  const JointBox box = box_with({0.55}, 0.4899);
  EXPECT_LT(box.max[2], 0.49);
  EXPECT_GE(box.max[2], 0.4899);
}

TEST(Planner, CutsNoPanOrTiltAtAnObstacle) {
  const World world(free_cube([](UncertaintyMap& map) {
    map.set(map.lattice().key({0.03, 0.02, 0.55}), occupied(1.0F));
  }));
  const PlanRequest request = request_at(kMiddle, 0.3);
  const JointBox box = world.planner().reachable_box(request);
  const JointBox reachable = Mast(world.robot.mast).reachable_box(kMiddle, 0.3);
  EXPECT_EQ(box.min.head<2>(), reachable.min.head<2>());
  EXPECT_EQ(box.max.head<2>(), reachable.max.head<2>());
}

std::vector<std::string> warnings_of(const World& world, const PlanRequest& request) {
  return world.planner().plan(request, *pan_grid(0.5)).warnings;
}

TEST(Planner, WarnsOfAMapThatCannotBeRight) {
  const PlanRequest request = request_at(kMiddle, 0.5);
  const auto at = [](const Eigen::Vector3d& p_m, float uncertainty) {
    return [=](UncertaintyMap& map) { map.set(map.lattice().key(p_m), occupied(uncertainty)); };
  };
  EXPECT_THAT(warnings_of(World(free_cube(at({1.5, 0, 0.4}, 0.5F))), request), IsEmpty());
  EXPECT_THAT(warnings_of(World(free_cube()), request),
              ElementsAre("the map has no occupied voxel"));
  EXPECT_THAT(warnings_of(World(free_cube(at({1.5, 0, 0.4}, 1.0F))), request),
              ElementsAre(HasSubstr("carries no uncertainty: every occupied voxel counts with u = "
                                    "1")));

  PlanRequest outside = request;
  outside.T_map_base = base_pose(100.0, 0.0, 0.0, 0.0);
  EXPECT_THAT(warnings_of(World(free_cube(at({1.5, 0, 0.4}, 0.5F))), outside),
              ElementsAre(HasSubstr("the base is outside the map")));
  PlanRequest in_the_unknown = request;
  in_the_unknown.T_map_base = base_pose(2.3, 0.0, 0.0, 0.0);
  EXPECT_THAT(warnings_of(World(free_cube(at({1.5, 0, 0.4}, 0.5F))), in_the_unknown),
              ElementsAre(HasSubstr("stands in unmapped space")));
}

TEST(Planner, RefusesARequestThatIsNotUsable) {
  const World world(free_cube());
  const auto message = [&](const std::function<void(PlanRequest&)>& spoil) {
    PlanRequest request = request_at(kMiddle, 0.5);
    spoil(request);
    return message_of<InputError>([&] { world.planner().plan(request, *pan_grid(0.5)); });
  };
  EXPECT_EQ(message([](PlanRequest&) {}), "");
  EXPECT_THAT(message([](auto& r) { r.T_map_base.translation().y() = kNaN; }), HasSubstr("base"));
  EXPECT_THAT(message([](auto& r) { r.T_map_base.linear()(0, 0) = kNaN; }), HasSubstr("base"));
  EXPECT_THAT(message([](auto& r) { r.motion_time_s = -1.0; }), HasSubstr("motion_time_s is -1 s"));
  EXPECT_THAT(message([](auto& r) { r.motion_time_s = kNaN; }), HasSubstr("motion_time_s is nan"));
  EXPECT_THAT(message([](auto& r) { r.joints.pan_rad = kNaN; }), HasSubstr("pan is nan rad"));
  EXPECT_THAT(message([](auto& r) { r.joints.tilt_rad = 0.81; }), HasSubstr("tilt is 0.81 rad"));
  EXPECT_THAT(message([](auto& r) { r.joints.height_m = 0.17; }), HasSubstr("height is 0.17 m"));
  EXPECT_THAT(message([](auto& r) { r.base_twist.wz_rad_s = kNaN; }), HasSubstr("base_twist"));
  EXPECT_THAT(message([](auto& r) { r.base_twist.vx_m_s = 1e3; }),
              HasSubstr("base_twist: the base would drive 500 m"));
  EXPECT_THAT(message([](auto& r) { r.T_map_base.translation().x() = 1e300; }),
              HasSubstr("lattice"));
}

TEST(Planner, MovesJointsALittleBeyondTheirLimitsIntoThem) {
  const World world(UncertaintyMap(0.1));
  PlanRequest request = request_at({0.0, 0.795, 0.178}, 0.5);
  const PlanResult result = world.planner().plan(request, *pan_grid(0.5));
  EXPECT_THAT(result.warnings, Contains(HasSubstr("tilt is 0.795 rad, moved into its limits")));
  EXPECT_THAT(result.warnings, Contains(HasSubstr("height is 0.178 m, moved into its limits")));
  request.joints = {0.0, 0.79, 0.18};
  expect_contract(world, request, result);
}

TEST(Planner, AnswersWithTheBestSoFarWhenStopped) {
  const UncertaintyMap map = free_cube();
  const World world(map, [](double yaw, double, double) { return 100.0 + std::cos(yaw - 0.75); });
  const auto stopped = [&](const std::function<void(StopRule&)>& stop) {
    PlanRequest request = request_at(kMiddle, 0.5);
    stop(request.stop);
    const PlanResult result = world.planner().plan(request, *pan_grid(0.25));
    expect_contract(world, request, result);
    return result;
  };
  const PlanResult cancelled = stopped([](StopRule& stop) { stop.cancel.cancel(); });
  EXPECT_EQ(cancelled.status, PlanStatus::cancelled);
  EXPECT_EQ(cancelled.joints, kMiddle);
  const PlanResult expired =
      stopped([](StopRule& stop) { stop.deadline = StopRule::Clock::now(); });
  EXPECT_EQ(expired.status, PlanStatus::time_limit);
  EXPECT_EQ(expired.joints, kMiddle);
  const PlanResult limited = stopped([](StopRule& stop) { stop.max_evaluations = 4; });
  EXPECT_EQ(limited.status, PlanStatus::evaluation_limit);
  EXPECT_EQ(limited.evaluations, 4);
}

/// A search that was cut short cannot say that there is nothing to gain.
TEST(Planner, SaysThatThereIsNoGainOnlyAfterAWholeSearch) {
  const World world(free_cube());
  PlanRequest request = request_at(kMiddle, 0.5);
  request.stop.max_evaluations = 2;
  EXPECT_EQ(world.planner().plan(request, *pan_grid(0.25)).status, PlanStatus::evaluation_limit);
}

TEST(Planner, ReachesEveryVoxelThatAViewCanTouch) {
  const World world(free_cube());
  std::mt19937_64 random(9);
  expect_views_within_reach(world, request_at(kMiddle, 0.3), random);
}

TEST(PlanResult, IsBornAsNotRun) {
  const PlanResult result;
  EXPECT_EQ(result.status, PlanStatus::not_run);
  EXPECT_EQ(result.message, "the planner was not called");
  EXPECT_TRUE(std::isnan(result.view.gain));
  EXPECT_TRUE(std::isnan(result.move_time_s));
}

}  // namespace
}  // namespace nbvopt::test
