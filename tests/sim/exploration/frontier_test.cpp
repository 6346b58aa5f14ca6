#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sim/exploration/frontier_filter.hpp"
#include "sim/exploration/frontier_trees.hpp"
#include "sim/exploration/goal_assignment.hpp"
#include "sim/exploration/marked_grid.hpp"

namespace nbvopt {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr double kCell_m = 0.05;

/// A room of 4 x 4 m, walls on three sides; its right side, at x = 4, ends in the unknown.
OccupancyGrid open_room() {
  OccupancyGrid grid(kCell_m);
  test::mark(grid, {0.01, 0.01}, {3.99, 3.99}, CellState::free);
  test::mark(grid, {-0.01, -0.01}, {3.99, -0.01}, CellState::occupied);
  test::mark(grid, {-0.01, 4.01}, {3.99, 4.01}, CellState::occupied);
  test::mark(grid, {-0.01, -0.01}, {-0.01, 4.01}, CellState::occupied);
  return grid;
}

OccupancyGrid closed_room() {
  OccupancyGrid grid = open_room();
  test::mark(grid, {4.01, -0.01}, {4.01, 4.01}, CellState::occupied);
  return grid;
}

TEST(FrontierTrees, FindWhereFreeSpaceEndsInTheUnknown) {
  const OccupancyGrid grid = open_room();
  FrontierTrees trees({1.0, 1.0}, 1);
  std::vector<Eigen::Vector2d> frontiers;
  for (int i = 0; i < 50; ++i) {
    for (const Eigen::Vector2d& point : trees.grow(grid, {2.0, 2.0})) frontiers.push_back(point);
  }
  EXPECT_FALSE(frontiers.empty());
  for (const Eigen::Vector2d& point : frontiers) {
    const Cell cell = grid.cell_at(point);
    EXPECT_EQ(grid.state(cell), CellState::free);
    EXPECT_EQ(grid.state(cell + Cell(1, 0)), CellState::unknown) << "only the right side is open";
  }
}

TEST(FrontierTrees, FindNoneInAClosedRoom) {
  const OccupancyGrid grid = closed_room();
  FrontierTrees trees({1.0, 1.0}, 1);
  for (int i = 0; i < 50; ++i) EXPECT_THAT(trees.grow(grid, {2.0, 2.0}), IsEmpty());
}

TEST(FrontierTrees, FollowTheirSeed) {
  const OccupancyGrid grid = open_room();
  const auto frontiers = [&](std::uint64_t seed) {
    FrontierTrees trees({1.0, 1.0}, seed);
    std::vector<Eigen::Vector2d> all;
    for (int i = 0; i < 10; ++i) {
      for (const Eigen::Vector2d& point : trees.grow(grid, {2.0, 2.0})) all.push_back(point);
    }
    return all;
  };
  EXPECT_EQ(frontiers(3), frontiers(3));
  EXPECT_NE(frontiers(3), frontiers(4));
}

TEST(RapidTree, GrowsNoEdgeThroughAWall) {
  OccupancyGrid grid = open_room();
  test::mark(grid, {2.01, 0.01}, {2.01, 3.99}, CellState::occupied);
  RapidTree tree({1.0, 1.0});
  EXPECT_FALSE(tree.grow(grid, {3.5, 1.0}, 9.0)) << "an occupied cell comes first";
  // Had the edge become part of the tree, its end would see the unknown.
  EXPECT_FALSE(tree.grow(grid, {4.5, 1.0}, 1.2));
}

TEST(UnknownArea, IsHalfADiscAtAStraightBorder) {
  const OccupancyGrid grid = open_room();
  EXPECT_NEAR(unknown_area_m2(grid, {3.99, 2.0}), 0.5 * std::numbers::pi, 0.1);
  EXPECT_EQ(unknown_area_m2(grid, {2.0, 2.0}), 0.0);
}

TEST(UnknownArea, DoesNotCountWhatLiesBehindAWall) {
  EXPECT_EQ(unknown_area_m2(closed_room(), {3.9, 2.0}), 0.0);
}

TEST(FrontierFilter, KeepsOneOfManyNeighbours) {
  const OccupancyGrid grid = open_room();
  FrontierFilter filter;
  const std::vector<Eigen::Vector2d> points{
      {3.97, 2.0}, {3.97, 2.2}, {3.97, 1.8}, {3.97, 3.0}, {2.0, 2.0}};
  filter.add(grid, points);
  filter.add(grid, points);
  ASSERT_THAT(filter.frontiers(), SizeIs(2)) << "and none where all is known";
  EXPECT_EQ(filter.frontiers()[0].position_map_m, points[0]);
  EXPECT_EQ(filter.frontiers()[1].position_map_m, points[3]);
}

TEST(FrontierFilter, DropsWhatBecameKnown) {
  OccupancyGrid grid = open_room();
  FrontierFilter filter;
  filter.add(grid, std::vector<Eigen::Vector2d>{{3.97, 2.0}});
  test::mark(grid, {4.01, 0.01}, {5.99, 3.99}, CellState::free);
  filter.update(grid);
  EXPECT_THAT(filter.frontiers(), IsEmpty());
}

TEST(FrontierFilter, RefusesWhatWasVisitedAndForAWhileWhatIsOutOfReach) {
  const OccupancyGrid grid = open_room();
  const std::vector<Eigen::Vector2d> points{{3.97, 1.0}, {3.97, 3.0}};
  FrontierFilter filter;
  filter.add(grid, points);
  filter.give_up(points[0]);
  filter.set_aside(points[1]);
  EXPECT_THAT(filter.frontiers(), IsEmpty());
  filter.add(grid, points);
  EXPECT_THAT(filter.frontiers(), IsEmpty());
  filter.forget_aside();
  filter.add(grid, points);
  ASSERT_THAT(filter.frontiers(), SizeIs(1));
  EXPECT_EQ(filter.frontiers()[0].position_map_m, points[1]);
}

/// An open room with what drives through it.
class AssignGoalTest : public testing::Test {
 protected:
  void wall(const Eigen::Vector2d& min_m, const Eigen::Vector2d& max_m) {
    field_.add_occupied(test::mark(grid_, min_m, max_m, CellState::occupied));
  }

  OccupancyGrid grid_ = open_room();
  ClearanceField field_{kCell_m, 0.7};
  DriveCosts costs_{grid_, field_, {0.27, 0.7, false}};
};

TEST_F(AssignGoalTest, PrefersTheNearerOfEqualFrontiers) {
  const std::vector<Frontier> frontiers{{{3.97, 3.5}, 1.0}, {{3.97, 1.5}, 1.0}};
  const Assignment assignment = assign_goal(costs_, frontiers, {2.0, 1.0});
  ASSERT_TRUE(assignment.goal);
  EXPECT_EQ(assignment.goal->frontier_map_m, frontiers[1].position_map_m);
  EXPECT_THAT(assignment.unreachable_map_m, IsEmpty());
  EXPECT_NEAR(assignment.goal->path.length_m(), std::hypot(1.97, 0.5), 0.05);
}

TEST_F(AssignGoalTest, WeighsTheUnknownAgainstTheWay) {
  const std::vector<Frontier> frontiers{{{3.97, 3.5}, 1.5}, {{3.97, 1.5}, 0.3}};
  const Assignment assignment = assign_goal(costs_, frontiers, {2.0, 1.0});
  ASSERT_TRUE(assignment.goal);
  EXPECT_EQ(assignment.goal->frontier_map_m, frontiers[0].position_map_m);
}

TEST_F(AssignGoalTest, CountsTheWayNotTheDistance) {
  wall({2.01, 0.01}, {2.01, 2.99});
  // The first is nearer, but behind the wall.
  const std::vector<Frontier> frontiers{{{2.5, 0.5}, 0.5}, {{0.5, 3.5}, 0.5}};
  const Assignment assignment = assign_goal(costs_, frontiers, {1.0, 0.5});
  ASSERT_TRUE(assignment.goal);
  EXPECT_EQ(assignment.goal->frontier_map_m, frontiers[1].position_map_m);
}

TEST_F(AssignGoalTest, NamesWhatCannotBeReached) {
  wall({2.01, 0.01}, {2.01, 3.99});
  const std::vector<Frontier> frontiers{{{3.97, 1.0}, 1.5}};
  const Assignment assignment = assign_goal(costs_, frontiers, {1.0, 1.0});
  EXPECT_FALSE(assignment.goal);
  EXPECT_EQ(assignment.unreachable_map_m, std::vector{frontiers[0].position_map_m});
}

TEST_F(AssignGoalTest, ApproachesAFrontierInACornerFromItsSideOfTheWall) {
  wall({2.01, 0.01}, {2.01, 3.99});
  const Eigen::Vector2d beside_m(1.96, 2.0);  // too near to the wall to stand there
  const auto cell = approach_cell(costs_, beside_m);
  ASSERT_TRUE(cell);
  EXPECT_TRUE(costs_.is_passable(*cell));
  EXPECT_LT(grid_.centre_map_m(*cell).x(), 2.0);
}

}  // namespace
}  // namespace nbvopt
