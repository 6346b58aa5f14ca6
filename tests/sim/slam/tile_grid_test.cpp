// Grids that share tiles until one of them writes.
#include "sim/slam/tile_grid.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nbvopt::test {
namespace {

/// What a grid holds of a cell.
struct BeamCell {
  std::uint32_t beams = 0;
  std::uint32_t hits = 0;
  bool is_occupied = false;
  Eigen::Vector2f mean_hit = Eigen::Vector2f::Zero();
};

BeamCell cell_of(const TileGrid& grid, const Cell& cell) {
  const Tile* tile = grid.find(tile_of(cell));
  if (tile == nullptr) return {};
  const std::size_t index = index_in_tile(cell);
  return {tile->beams[index], tile->hits[index], tile->is_occupied(index), tile->mean_hit(index)};
}

/// A grid of cells of a metre with one hit.
TileGrid grid_with_hit(const Eigen::Vector2d& end_map_m) {
  TileGrid grid(1.0);
  grid.insert_scan({0.5, 0.5}, std::vector<Beam>{{end_map_m, true}});
  return grid;
}

TEST(TileGrid, CountsBeamsAndKeepsWhereTheyHit) {
  TileGrid grid = grid_with_hit({3.25, 0.75});
  grid.insert_scan({0.5, 0.5}, std::vector<Beam>{{{3.75, 0.25}, true}, {{2.5, 0.5}, false}});
  EXPECT_EQ(cell_of(grid, {1, 0}).beams, 3U);
  EXPECT_FALSE(cell_of(grid, {1, 0}).is_occupied);
  EXPECT_EQ(cell_of(grid, {2, 0}).beams, 3U);
  EXPECT_FALSE(cell_of(grid, {2, 0}).is_occupied) << "cropped beams hit nothing";
  const BeamCell hit = cell_of(grid, {3, 0});
  EXPECT_EQ(hit.hits, 2U);
  EXPECT_TRUE(hit.is_occupied);
  EXPECT_TRUE(hit.mean_hit.isApprox(Eigen::Vector2f(0.5F, 0.5F)));
  EXPECT_EQ(cell_of(grid, {4, 0}).beams, 0U);
}

TEST(TileGrid, FreesACellThatManyBeamsPass) {
  TileGrid grid = grid_with_hit({3.25, 0.75});
  const std::vector<Beam> through(10, Beam{{6.5, 0.5}, false});
  grid.insert_scan({0.5, 0.5}, through);
  EXPECT_FALSE(cell_of(grid, {3, 0}).is_occupied);
}

TEST(TileGrid, ReachesToNegativeCells) {
  const TileGrid grid = grid_with_hit({-40.5, -33.25});
  EXPECT_TRUE(cell_of(grid, {-41, -34}).is_occupied);
}

TEST(TileGrid, SharesHistoryAndNothingElse) {
  TileGrid grid = grid_with_hit({100.5, 0.5});
  TileGrid other = grid.share();
  for (int tile = 0; tile <= 3; ++tile) {
    ASSERT_NE(grid.find({tile, 0}), nullptr);
    EXPECT_EQ(grid.find({tile, 0}), other.find({tile, 0})) << "not copied";
  }

  other.insert_scan({0.5, 0.5}, std::vector<Beam>{{{20.5, 0.5}, true}});
  EXPECT_TRUE(cell_of(other, {20, 0}).is_occupied);
  EXPECT_FALSE(cell_of(grid, {20, 0}).is_occupied);
  EXPECT_NE(grid.find({0, 0}), other.find({0, 0})) << "written";
  EXPECT_EQ(grid.find({1, 0}), other.find({1, 0})) << "not written";

  grid.insert_scan({0.5, 0.5}, std::vector<Beam>{{{10.5, 0.5}, true}});
  EXPECT_TRUE(cell_of(grid, {10, 0}).is_occupied);
  EXPECT_FALSE(cell_of(other, {10, 0}).is_occupied);
  EXPECT_EQ(cell_of(other, {20, 0}).beams, 2U);
  EXPECT_EQ(cell_of(grid, {20, 0}).beams, 1U);
}

TEST(TileGrid, WritesIntoItsOwnTilesInPlace) {
  TileGrid grid = grid_with_hit({100.5, 0.5});
  const Tile* tile = grid.find({0, 0});
  grid.insert_scan({0.5, 0.5}, std::vector<Beam>{{{20.5, 0.5}, true}});
  EXPECT_EQ(grid.find({0, 0}), tile);
}

}  // namespace
}  // namespace nbvopt::test
