#include "nbvopt/sim/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "sim/exploration/cell_walk.hpp"
#include "sim/exploration/clearance_field.hpp"

namespace nbvopt {
namespace {

std::vector<Cell> insert_beam(OccupancyGrid& grid, const Eigen::Vector2d& from_m,
                              const Eigen::Vector2d& to_m, bool is_hit) {
  const Beam beam{to_m, is_hit};
  return grid.insert_scan(from_m, {&beam, 1});
}

TEST(OccupancyGrid, NamesCellsOnBothSidesOfZero) {
  const OccupancyGrid grid(0.5);
  EXPECT_EQ(grid.cell_at({0.1, 0.6}), Cell(0, 1));
  EXPECT_EQ(grid.cell_at({-0.1, -0.6}), Cell(-1, -2));
  EXPECT_EQ(grid.centre_map_m({-1, 2}), Eigen::Vector2d(-0.25, 1.25));
  EXPECT_TRUE(grid.bounds().isEmpty());
  EXPECT_EQ(grid.state({7, 7}), CellState::unknown);
}

TEST(OccupancyGrid, RefusesCellsWithoutAnEdge) {
  EXPECT_THROW(OccupancyGrid(0.0), InputError);
  EXPECT_THROW(OccupancyGrid(-1.0), InputError);
  EXPECT_THROW(OccupancyGrid(std::nan("")), InputError);
}

TEST(OccupancyGrid, MarksWhatABeamSaw) {
  OccupancyGrid grid(1.0);
  EXPECT_EQ(insert_beam(grid, {0.5, 0.5}, {3.5, 0.5}, true), std::vector{Cell(3, 0)});
  EXPECT_EQ(grid.state({0, 0}), CellState::free);
  EXPECT_EQ(grid.state({2, 0}), CellState::free);
  EXPECT_EQ(grid.state({3, 0}), CellState::occupied);
  EXPECT_EQ(grid.state({4, 0}), CellState::unknown);
  EXPECT_EQ(grid.state({1, 1}), CellState::unknown);
  EXPECT_TRUE(insert_beam(grid, {0.5, 0.5}, {3.5, 0.5}, true).empty()) << "it was occupied before";
}

TEST(OccupancyGrid, ACroppedBeamEndsInFreeSpace) {
  OccupancyGrid grid(1.0);
  EXPECT_TRUE(insert_beam(grid, {0.5, 0.5}, {0.5, -2.5}, false).empty());
  EXPECT_EQ(grid.state({0, -3}), CellState::free);
}

TEST(OccupancyGrid, OneHitIsProof) {
  OccupancyGrid grid(1.0);
  insert_beam(grid, {0.5, 0.5}, {2.5, 0.5}, true);
  for (int i = 0; i < 10; ++i) insert_beam(grid, {0.5, 0.5}, {5.5, 0.5}, false);
  EXPECT_EQ(grid.state({2, 0}), CellState::occupied);
  insert_beam(grid, {0.5, 0.5}, {4.5, 0.5}, true);
  EXPECT_EQ(grid.state({4, 0}), CellState::occupied) << "a free cell that is hit later";
}

TEST(OccupancyGrid, GrowsAndKeepsWhatItKnows) {
  OccupancyGrid grid(0.05);
  insert_beam(grid, {0.0, 0.0}, {1.0, 0.0}, true);
  const Cell hit = grid.cell_at({1.0, 0.0});
  insert_beam(grid, {-30.0, 20.0}, {-31.0, 20.0}, true);
  insert_beam(grid, {40.0, -20.0}, {40.0, -21.0}, false);
  EXPECT_EQ(grid.state(hit), CellState::occupied);
  EXPECT_EQ(grid.state(grid.cell_at({0.51, 0.01})), CellState::free);
  EXPECT_EQ(grid.state(grid.cell_at({-30.51, 20.01})), CellState::free);
  EXPECT_EQ(grid.bounds().min(), grid.cell_at({-31.0, -21.0}));
  EXPECT_EQ(grid.bounds().max(), grid.cell_at({40.0, 20.0}));
}

TEST(CellWalk, IsAChainOfNeighboursThatHoldsTheSegment) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(-9.0, 9.0);
  for (int trial = 0; trial < 2000; ++trial) {
    // Every fourth segment starts and ends on borders of cells.
    const bool is_on_borders = trial % 4 == 0;
    Eigen::Vector2d from(coordinate(random), coordinate(random));
    Eigen::Vector2d to(coordinate(random), coordinate(random));
    if (is_on_borders) from = from.array().round(), to = to.array().round();
    std::vector<Cell> cells;
    walk_cells(from, to, [&](const Cell& cell) {
      cells.push_back(cell);
      return true;
    });
    EXPECT_EQ(cells.front(), Cell(from.array().floor().cast<int>()));
    EXPECT_EQ(cells.back(), Cell(to.array().floor().cast<int>()));
    for (std::size_t i = 1; i < cells.size(); ++i) {
      ASSERT_EQ((cells[i] - cells[i - 1]).cwiseAbs().sum(), 1);
    }
    for (const Cell& cell : cells) {  // the segment comes within half a diagonal of its centre
      const Eigen::Vector2d centre = cell.cast<double>() + Eigen::Vector2d(0.5, 0.5);
      const Eigen::Vector2d way = to - from;
      const double part =
          std::clamp((centre - from).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
      ASSERT_LE((from + part * way - centre).norm(), std::sqrt(0.5) + 1e-9);
    }
  }
}

TEST(CellWalk, EndsWhenTold) {
  int visits = 0;
  walk_cells({0.5, 0.5}, {9.5, 0.5}, [&](const Cell&) { return ++visits < 3; });
  EXPECT_EQ(visits, 3);
}

TEST(ClearanceField, IsTheDistanceToTheNearestOccupiedCell) {
  constexpr double kCell_m = 0.05;
  constexpr double kReach_m = 0.6;
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> coordinate(-40, 40);
  ClearanceField field(kCell_m, kReach_m);
  std::vector<Cell> all;
  for (int batch = 0; batch < 4; ++batch) {  // it grows batch by batch, as scans come
    std::vector<Cell> cells;
    for (int i = 0; i < 5; ++i) cells.emplace_back(coordinate(random), coordinate(random));
    field.add_occupied(cells);
    all.insert(all.end(), cells.begin(), cells.end());
    for (int y = -60; y <= 60; ++y) {
      for (int x = -60; x <= 60; ++x) {
        double nearest_m = kReach_m;
        for (const Cell& cell : all) {
          nearest_m = std::min(nearest_m, (cell - Cell(x, y)).cast<double>().norm() * kCell_m);
        }
        ASSERT_NEAR(field.clearance_m({x, y}), nearest_m, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace nbvopt
