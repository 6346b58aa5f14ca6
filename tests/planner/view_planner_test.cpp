// The front door answers as the parts that stand behind it.
#include "nbvopt/planner/view_planner.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "nbvopt/solver/registry.hpp"
#include "planner/planner.hpp"
#include "support/error_message.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A room of 4 x 4 x 1 m with a badly seen wall ahead; all else is unknown.
UncertaintyMap room() {
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-2.0, -2.0, 0.0}, {2.0, 2.0, 1.0}), kFree);
  set_box(map, keys_between(map.lattice(), {2.0, -2.0, 0.0}, {2.1, 2.0, 1.0}), occupied(0.7F));
  map.finish_writing();
  return map;
}

Robot small_robot(Counting counting = Counting::per_ray) {
  Robot robot;
  robot.sensor.horizontal_rays = 16;
  robot.sensor.vertical_rays = 12;
  robot.sensor.range_max_m = 3.0;
  robot.sensor.counting = counting;
  return robot;
}

PlanRequest request_in_room() {
  PlanRequest request;
  request.T_map_base = base_pose(0.03, 0.02, 0.01, 0.3);
  request.joints = {.pan_rad = 0.2, .tilt_rad = -0.1, .height_m = 0.4};
  request.motion_time_s = 0.6;
  request.seed = 7;
  request.stop.max_evaluations = 120;
  return request;
}

/// A wall that a camera in the room sees beside the known one.
Scan scan_of_wall() {
  Scan scan;
  for (int i = -20; i <= 20; ++i) {
    for (int j = -10; j <= 10; ++j) {
      scan.points_m.emplace_back(0.04F * static_cast<float>(i), 0.04F * static_cast<float>(j),
                                 2.05F);
    }
  }
  return scan;
}

Transform scan_pose(double yaw_rad) {
  Transform T_map_sensor = base_pose(0.0, 0.0, 0.5, yaw_rad);
  T_map_sensor.linear() = T_map_sensor.linear() * rotation_body_sensor();
  return T_map_sensor;
}

void expect_same(const PlanResult& a, const PlanResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.joints, b.joints);
  EXPECT_EQ(a.T_map_sensor.matrix(), b.T_map_sensor.matrix());
  EXPECT_EQ(a.T_map_base.matrix(), b.T_map_base.matrix());
  EXPECT_EQ(a.view, b.view);
  EXPECT_EQ(a.current, b.current);
  EXPECT_EQ(a.move_time_s, b.move_time_s);
  EXPECT_EQ(a.box.min, b.box.min);
  EXPECT_EQ(a.box.max, b.box.max);
  EXPECT_EQ(a.active_bounds, b.active_bounds);
  EXPECT_EQ(a.evaluations, b.evaluations);
  EXPECT_EQ(a.surrogate_evaluations, b.surrogate_evaluations);
  EXPECT_EQ(a.solver, b.solver);
  EXPECT_EQ(a.warnings, b.warnings);
}

class Evaluators : public testing::TestWithParam<const char*> {
 protected:
  std::string evaluator() const { return GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(All, Evaluators, testing::Values("exact", "paper-code"));

TEST_P(Evaluators, PlanAsTheirPartsByAnySearch) {
  const UncertaintyMap map = room();
  Robot robot = small_robot();
  robot.sensor = evaluator_sensor(evaluator(), robot.sensor);
  const auto grid = VoxelGrid::whole(map);
  const Planner parts(robot, grid, make_evaluator(evaluator(), map, grid, robot.sensor));
  const ViewPlanner planner(room(), small_robot(), evaluator());
  EXPECT_EQ(planner.robot(), robot);
  EXPECT_EQ(planner.evaluator(), evaluator());

  for (const BaseTwist& twist : {BaseTwist{}, BaseTwist{0.3, 0.1, 0.5}}) {
    PlanRequest request = request_in_room();
    request.base_twist = twist;
    expect_same(planner.plan(request), parts.plan(request, *make_solver("auto", {})));
    for (const char* name : {"grid", "random", "nlopt:crs2", "auto"}) {
      SCOPED_TRACE(name);
      const std::vector<double> steps{0.3, 0.2, 0.1};
      const auto solver = make_solver(name, {.grid_steps = steps});
      const PlanResult expected = parts.plan(request, *solver);
      EXPECT_GT(expected.evaluations, 1);
      expect_same(planner.plan(request, {.solver = name, .grid_steps = steps}), expected);
      expect_same(planner.plan(request, *solver), expected);
    }
  }
}

TEST_P(Evaluators, PlanOnAGrownMapAsOnAFreshOne) {
  ViewPlanner planner(room(), small_robot(), evaluator());
  UncertaintyMap grown = room();
  const PlanResult before = planner.plan(request_in_room());
  PlanResult look;
  for (int i = 0; i < 4; ++i) {
    const Transform pose = scan_pose(0.4 * i - 0.3);
    const InsertResult expected = insert_scan(grown, scan_of_wall(), pose, planner.robot().sensor);
    const InsertResult inserted = planner.insert(scan_of_wall(), pose);
    EXPECT_EQ(inserted.changes.size(), expected.changes.size());
    EXPECT_EQ(inserted.information_gained, expected.information_gained);

    look = planner.plan(request_in_room());
    EXPECT_EQ(look.map_version, static_cast<std::uint64_t>(i + 2));
    EXPECT_EQ(planner.map_version(), look.map_version);
    const auto grid = VoxelGrid::whole(grown);
    const Robot& robot = planner.robot();
    const Planner fresh(robot, grid, make_evaluator(evaluator(), grown, grid, robot.sensor));
    expect_same(look, fresh.plan(request_in_room(), *make_solver("auto", {})));
  }
  EXPECT_NE(look.current, before.current) << "the scans lie in view";
}

TEST_P(Evaluators, JudgeViewsInTheirOrder) {
  const ViewPlanner planner(room(), small_robot(), evaluator());
  std::vector<Transform> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(scan_pose(0.3 * i));
  const std::vector<ViewGain> gains = planner.evaluate(poses);
  ASSERT_EQ(gains.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(gains[i], planner.evaluate(poses[i])) << i;
  }
  EXPECT_NE(gains[0], gains[7]);
  EXPECT_EQ(planner.evaluate(poses, 1), gains);
}

TEST(ViewPlanner, TellsHowTheGainLiesAroundAnAnswer) {
  const ViewPlanner planner(room(), small_robot());
  PlanRequest request = request_in_room();
  request.base_twist = {0.3, 0.1, 0.5};
  const PlanResult look = planner.plan(request);
  const Landscape landscape = planner.landscape(look);
  ASSERT_EQ(landscape.gain.size(), landscape.pan_rad.size() * landscape.tilt_rad.size());
  EXPECT_EQ(landscape.height_m, look.joints.height_m);
  const auto best = std::ranges::max_element(landscape.gain) - landscape.gain.begin();
  const auto columns = static_cast<std::ptrdiff_t>(landscape.pan_rad.size());
  const JointPosition q{landscape.pan_rad[static_cast<std::size_t>(best % columns)],
                        landscape.tilt_rad[static_cast<std::size_t>(best / columns)],
                        landscape.height_m};
  EXPECT_TRUE(look.box.contains(q.vector()));
  EXPECT_EQ(landscape.gain[static_cast<std::size_t>(best)],
            planner.evaluate(T_map_sensor(request, planner.mast(), q)).gain);
  EXPECT_GT(landscape.gain[static_cast<std::size_t>(best)], 0.0);
}

TEST(ViewPlanner, MovesJointsIntoTheirLimitsWithAWarning) {
  const ViewPlanner planner(room(), small_robot());
  PlanRequest request = request_in_room();
  request.joints.tilt_rad = 0.795;
  const PlanResult look = planner.plan(request);
  EXPECT_THAT(look.warnings, Contains(HasSubstr("tilt is 0.795 rad, moved into its limits")));
  EXPECT_EQ(look.request.joints.tilt_rad, 0.79) << "the question that it answers";
  EXPECT_EQ(planner.reachable_box(request).max, look.box.max);
  request.joints.tilt_rad = 1.0;
  EXPECT_THROW(planner.plan(request), InputError);
  EXPECT_THROW(planner.reachable_box(request), InputError);
  EXPECT_THROW(planner.make_ready(request), InputError);
}

TEST(ViewPlanner, ReadsTheVoxelsInReachOnce) {
  const ViewPlanner planner(room(), small_robot());
  const auto grid = planner.grid();
  const std::size_t unread = grid->memory_bytes();
  planner.make_ready(request_in_room());
  const std::size_t ready = grid->memory_bytes();
  EXPECT_GT(ready, unread);
  const PlanResult look = planner.plan(request_in_room());
  EXPECT_EQ(planner.grid(), grid);
  EXPECT_EQ(grid->memory_bytes(), ready);
  EXPECT_GE(look.grid_ms, 0.0);
  EXPECT_GT(look.search_time_ms, 0.0);
}

TEST(ViewPlanner, SharesAMapWithOthers) {
  const auto map = std::make_shared<SharedMap>(room());
  ViewPlanner planner(map, small_robot());
  const ViewPlanner other(map, small_robot(Counting::per_voxel));
  const PlanResult before = other.plan(request_in_room());
  const auto old_grid = planner.grid();
  EXPECT_EQ(old_grid, other.grid());
  planner.insert(scan_of_wall(), scan_pose(0.3));
  EXPECT_NE(other.plan(request_in_room()).current, before.current);
  EXPECT_EQ(planner.grid(), other.grid());
  EXPECT_EQ(map->grid()->version(), 2U);
  const ViewPlanner past(old_grid, small_robot(Counting::per_voxel));
  EXPECT_EQ(past.plan(request_in_room()).current, before.current) << "versions never change";
}

TEST(ViewPlanner, KeepsTheMapWhereAScanIsRefused) {
  ViewPlanner planner(room(), small_robot());
  const PlanResult before = planner.plan(request_in_room());
  Transform nowhere = scan_pose(0.0);
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(planner.insert(scan_of_wall(), nowhere), InputError);
  EXPECT_EQ(planner.map_version(), 1U);
  expect_same(planner.plan(request_in_room()), before);
}

TEST(ViewPlanner, RefusesWhatItCannotJudge) {
  EXPECT_THROW(ViewPlanner(room(), Robot{}, "guess"), UsageError);
  Robot robot = small_robot(Counting::per_voxel);
  EXPECT_EQ(ViewPlanner(room(), robot, "paper-code").robot().sensor.counting, Counting::per_ray)
      << "the released code describes its own camera";
  EXPECT_THAT(
      message_of<UsageError>([&] { ViewPlanner::with_given_sensor(room(), robot, "paper-code"); }),
      HasSubstr("per_ray only"));
  robot.mast.height_min_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ViewPlanner(room(), robot), InputError);
}

TEST(ViewPlanner, TakesASensorAsItIsGiven) {
  Robot robot = small_robot();
  robot.sensor = paper_code_sensor(robot.sensor);
  robot.sensor.uncertainty_half_fov_horizontal_rad = 0.3;
  const ViewPlanner planner = ViewPlanner::with_given_sensor(room(), robot, "paper-code");
  EXPECT_EQ(planner.robot(), robot);
  const UncertaintyMap map = room();
  EXPECT_EQ(planner.evaluate(scan_pose(0.2)),
            make_paper_code_evaluator(map, robot.sensor)->evaluate(scan_pose(0.2)));
}

TEST(ViewPlanner, HasNoMapToInsertIntoOnAGrid) {
  const UncertaintyMap map = room();
  ViewPlanner planner(VoxelGrid::whole(map, 5), small_robot());
  EXPECT_EQ(planner.plan(request_in_room()).map_version, 5U);
  EXPECT_THAT(message_of<UsageError>([&] { planner.insert(scan_of_wall(), scan_pose(0.0)); }),
              HasSubstr("no map to insert into"));
}

/// For the thread sanitizer, too.
TEST(ViewPlannerConcurrency, EveryPlanSeesOneVersion) {
  constexpr int kScans = 12;
  std::vector<PlanResult> expected;
  {
    ViewPlanner alone(room(), small_robot());
    expected.push_back(alone.plan(request_in_room()));
    for (int i = 0; i < kScans; ++i) {
      alone.insert(scan_of_wall(), scan_pose(0.2 * i));
      expected.push_back(alone.plan(request_in_room()));
    }
  }
  ViewPlanner planner(room(), small_robot());
  std::vector<std::thread> threads;
  for (int t = 0; t < 2; ++t) {
    threads.emplace_back([&] {
      std::uint64_t version = 0;
      while (version < expected.size()) {
        const PlanResult look = planner.plan(request_in_room());
        EXPECT_GE(look.map_version, version);
        version = look.map_version;
        EXPECT_EQ(look.joints, expected[version - 1].joints);
        EXPECT_EQ(look.view, expected[version - 1].view);
      }
    });
  }
  for (int i = 0; i < kScans; ++i) planner.insert(scan_of_wall(), scan_pose(0.2 * i));
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace nbvopt::test
