#include "sim/exploration/grid_planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "sim/exploration/marked_grid.hpp"

namespace nbvopt {
namespace {

constexpr double kClearance_m = 0.3;

/// A free floor of 6 x 4 m inside walls, into which tests put more walls.
class GridPlannerTest : public testing::Test {
 protected:
  GridPlannerTest() {
    test::mark(grid_, {0.0, 0.0}, {5.99, 3.99}, CellState::free);
    wall({-0.05, -0.05}, {6.0, -0.05});
    wall({-0.05, 4.0}, {6.0, 4.0});
    wall({-0.05, -0.05}, {-0.05, 4.0});
    wall({6.0, -0.05}, {6.0, 4.0});
  }

  void wall(const Eigen::Vector2d& min_m, const Eigen::Vector2d& max_m) {
    field_.add_occupied(test::mark(grid_, min_m + kInside, max_m + kInside, CellState::occupied));
  }

  GridPlanner planner(const Eigen::Vector2d& start_m) const {
    return {costs_, start_m, grid_.bounds()};
  }

  /// Every cell on the path keeps the clearance.
  void expect_clear(const Path& path) const {
    for (double along_m = 0.0; along_m < path.length_m(); along_m += 0.01) {
      EXPECT_GE(field_.clearance_m(grid_.cell_at(path.point_at(along_m))), kClearance_m);
    }
  }

  /// From a cell's border into the cell.
  const Eigen::Vector2d kInside = Eigen::Vector2d::Constant(0.01);

  OccupancyGrid grid_{0.05};
  ClearanceField field_{0.05, 0.7};
  DriveCosts costs_{grid_, field_, {kClearance_m, 0.7, /*through_unknown=*/false}};
};

TEST_F(GridPlannerTest, TheOpenWayIsStraight) {
  const auto path = planner({1.01, 2.01}).path({5.01, 2.51});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->length_m(), std::hypot(4.0, 0.5), 1e-9);
  EXPECT_EQ(path->point_at(0.0), Eigen::Vector2d(1.01, 2.01));
  EXPECT_EQ(path->point_at(path->length_m()), Eigen::Vector2d(5.01, 2.51));
}

TEST_F(GridPlannerTest, GoesRoundAWallAndKeepsClear) {
  wall({3.0, 0.0}, {3.0, 2.5});
  const auto path = planner({1.0, 1.0}).path({5.0, 1.0});
  ASSERT_TRUE(path);
  expect_clear(*path);
  // No shorter than over the wall's end at the least clearance, and not much longer.
  const double shortest_m = 2.0 * std::hypot(2.0, 2.5 + kClearance_m - 1.0);
  EXPECT_GT(path->length_m(), shortest_m - 0.1);
  EXPECT_LT(path->length_m(), shortest_m + 0.8);
}

TEST_F(GridPlannerTest, PassesADoorButNoGap) {
  wall({3.0, 0.0}, {3.0, 1.5});
  wall({3.0, 2.2}, {3.0, 4.0});  // 0.65 m between the walls' cells
  const auto path = planner({1.0, 3.0}).path({5.0, 3.0});
  ASSERT_TRUE(path);
  expect_clear(*path);
  wall({3.0, 1.55}, {3.0, 1.65});
  EXPECT_FALSE(planner({1.0, 3.0}).path({5.0, 3.0}));
  EXPECT_FALSE(planner({1.0, 3.0}).cost_m(grid_.cell_at({5.0, 3.0})));
}

TEST_F(GridPlannerTest, KeepsOffWallsWhereThereIsRoom) {
  // Both ends stand near the lower wall; the cheapest way leaves it in between.
  const auto path = planner({0.5, 0.35}).path({5.5, 0.35});
  ASSERT_TRUE(path);
  EXPECT_GT(path->point_at(0.5 * path->length_m()).y(), 0.5);
  EXPECT_LT(path->length_m(), 5.5);
}

TEST_F(GridPlannerTest, PassesTheUnknownWhenItMay) {
  const Eigen::Vector2d beyond_m(3.0, 6.0);
  Eigen::AlignedBox2i box = grid_.bounds();
  box.extend(grid_.cell_at({-1.0, -1.0})).extend(grid_.cell_at({7.0, 7.0}));
  const DriveCosts bold(grid_, field_, {kClearance_m, 0.7, /*through_unknown=*/true});
  EXPECT_FALSE(GridPlanner(bold, {3.0, 2.0}, box).path(beyond_m)) << "walls all around";
  OccupancyGrid open(0.05);
  test::mark(open, {2.0, 1.0}, {4.0, 3.0}, CellState::free);
  const ClearanceField room(0.05, 0.7);
  const DriveCosts open_bold(open, room, {kClearance_m, 0.7, true});
  const DriveCosts open_careful(open, room, {kClearance_m, 0.7, false});
  EXPECT_TRUE(GridPlanner(open_bold, {3.0, 2.0}, box).path(beyond_m));
  EXPECT_FALSE(GridPlanner(open_careful, {3.0, 2.0}, box).path(beyond_m));
}

TEST_F(GridPlannerTest, LeavesAPlaceThatIsTooNarrow) {
  const Eigen::Vector2d start_m(0.12, 2.0);  // nearer to the wall than the clearance
  ASSERT_FALSE(costs_.is_passable(grid_.cell_at(start_m)));
  const auto path = planner(start_m).path({3.0, 2.0});
  ASSERT_TRUE(path);
  EXPECT_TRUE(std::isfinite(costs_.line_cost_m(path->point_at(0.0), path->rest(0.0)[1])));
  EXPECT_FALSE(planner({3.0, 2.0}).path(start_m)) << "but never goes to one";
}

TEST(GridPlanner, DoesNotSlipBetweenCellsThatMeetAtACorner) {
  OccupancyGrid grid(1.0);
  ClearanceField field(1.0, 2.0);
  test::mark(grid, {0.0, 0.0}, {1.5, 1.5}, CellState::free);
  const DriveCosts costs(grid, field, {0.5, 2.0, /*through_unknown=*/false});
  EXPECT_TRUE(GridPlanner(costs, {0.5, 0.5}, grid.bounds()).path({1.5, 1.5}));
  field.add_occupied(test::mark(grid, {0.0, 1.0}, {0.5, 1.5}, CellState::occupied));
  field.add_occupied(test::mark(grid, {1.0, 0.0}, {1.5, 0.5}, CellState::occupied));
  EXPECT_FALSE(GridPlanner(costs, {0.5, 0.5}, grid.bounds()).path({1.5, 1.5}));
}

TEST_F(GridPlannerTest, WaysDoNotDependOnThoseBefore) {
  wall({3.0, 0.0}, {3.0, 2.5});
  wall({1.5, 1.5}, {1.5, 4.0});
  std::vector<Eigen::Vector2d> goals_m;
  for (double y_m = 3.9; y_m > 0.0; y_m -= 0.17) {
    for (double x_m = 0.03; x_m < 6.0; x_m += 0.19) goals_m.emplace_back(x_m, y_m);
  }
  GridPlanner shared = planner({1.013, 1.027});
  GridPlanner backwards = planner({1.013, 1.027});
  std::vector<std::optional<Path>> after_others(goals_m.size());
  for (std::size_t i = goals_m.size(); i-- > 0;) after_others[i] = backwards.path(goals_m[i]);
  int ways = 0;
  for (std::size_t i = 0; i < goals_m.size(); ++i) {
    const auto path = shared.path(goals_m[i]);
    ASSERT_EQ(path.has_value(), after_others[i].has_value());
    // To plan each by itself takes long under sanitizers.
    const auto alone = i % 10 == 0 ? planner({1.013, 1.027}).path(goals_m[i]) : path;
    ASSERT_EQ(path.has_value(), alone.has_value());
    if (!path) continue;
    ++ways;
    EXPECT_EQ(path->rest(0.0), after_others[i]->rest(0.0)) << goals_m[i].transpose();
    EXPECT_EQ(path->rest(0.0), alone->rest(0.0)) << goals_m[i].transpose();
    EXPECT_EQ(path->point_at(path->length_m()), goals_m[i]);
  }
  EXPECT_GT(ways, 500);
}

TEST_F(GridPlannerTest, CostsDoNotDependOnTheOrderOfQuestions) {
  wall({3.0, 0.0}, {3.0, 2.5});
  const Cell near = grid_.cell_at({2.0, 1.0});
  const Cell far = grid_.cell_at({5.0, 1.0});
  GridPlanner near_first = planner({1.0, 1.0});
  GridPlanner far_first = planner({1.0, 1.0});
  const auto near_cost_m = near_first.cost_m(near);
  const auto far_cost_m = far_first.cost_m(far);
  ASSERT_TRUE(near_cost_m && far_cost_m);
  EXPECT_EQ(near_first.cost_m(far), far_cost_m);
  EXPECT_EQ(far_first.cost_m(near), near_cost_m);
  EXPECT_NEAR(*near_cost_m, 1.0, 0.05) << "with room, a way costs its length";
}

TEST_F(GridPlannerTest, TheWayToWhereTheBaseStandsIsThatPoint) {
  const auto path = planner({1.0, 1.0}).path({1.01, 1.01});
  ASSERT_TRUE(path);
  EXPECT_EQ(path->length_m(), 0.0);
  EXPECT_EQ(path->point_at(0.0), Eigen::Vector2d(1.01, 1.01));
}

TEST(Path, IsAddressedByDistance) {
  const Path path({{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}});
  EXPECT_EQ(path.length_m(), 5.0);
  EXPECT_EQ(path.point_at(-1.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(path.point_at(1.5), Eigen::Vector2d(1.5, 0.0));
  EXPECT_EQ(path.point_at(4.0), Eigen::Vector2d(2.0, 2.0));
  EXPECT_EQ(path.point_at(9.0), Eigen::Vector2d(2.0, 3.0));
  EXPECT_EQ(path.rest(1.0).size(), 3U);
  EXPECT_EQ(path.rest(2.5).size(), 2U);
  EXPECT_DOUBLE_EQ(path.nearest_m({2.5, 1.0}, 0.0, 5.0), 3.0);
  EXPECT_DOUBLE_EQ(path.nearest_m({2.5, 1.0}, 0.0, 2.5), 2.5) << "no farther than allowed";
  EXPECT_DOUBLE_EQ(path.nearest_m({0.0, 0.0}, 1.0, 5.0), 1.0) << "nor back";
}

}  // namespace
}  // namespace nbvopt
