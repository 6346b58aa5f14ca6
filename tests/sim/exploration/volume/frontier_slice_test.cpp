#include "sim/exploration/volume/frontier_slice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "sim/exploration/volume/drawn_map.hpp"

namespace nbvopt {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Cells = std::vector<std::pair<int, int>>;

constexpr int kLayer = 8;

/// Two rows open to the unknown above and below, which a column on the left joins.
class FrontierSlice : public testing::Test {
 protected:
  std::vector<Eigen::Vector2d> frontiers(bool looks_both_ways, int layer = kLayer) const {
    return slice_frontiers(*grid_, *map_.known_box(), test::key_at(0, 0, layer).z, looks_both_ways);
  }

  static Cells cells(const std::vector<Eigen::Vector2d>& points_map_m) {
    Cells cells;
    for (const Eigen::Vector2d& point : points_map_m) {
      const Eigen::Vector2d voxel = point / 0.05 - Eigen::Vector2d::Constant(0.5);
      EXPECT_NEAR(voxel.x(), std::round(voxel.x()), 1e-9);
      cells.emplace_back(std::lround(voxel.x()), std::lround(voxel.y()));
    }
    return cells;
  }

  UncertaintyMap map_ = test::drawn_layer({"???????",  //
                                           "?.....?",  //
                                           "?.....#",  //
                                           "?..#..#",  //
                                           "?.....?",  //
                                           "???????"},
                                          kLayer);
  std::shared_ptr<const VoxelGrid> grid_ = VoxelGrid::whole(map_);
};

TEST_F(FrontierSlice, HoldsFreeVoxelsBesideUnknownOnes) {
  EXPECT_EQ(cells(frontiers(/*looks_both_ways=*/true)), (Cells{{1, 1},
                                                               {2, 1},
                                                               {3, 1},
                                                               {4, 1},
                                                               {5, 1},
                                                               {1, 2},
                                                               {1, 3},
                                                               {1, 4},
                                                               {2, 4},
                                                               {3, 4},
                                                               {4, 4},
                                                               {5, 4}}));
}

TEST_F(FrontierSlice, MissesThoseTowardsPlusWhereItLooksAsReleased) {
  EXPECT_EQ(cells(frontiers(/*looks_both_ways=*/false)),
            (Cells{{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}, {1, 2}, {1, 3}, {1, 4}}));
}

TEST_F(FrontierSlice, KnowsNothingOfOtherLayers) {
  EXPECT_THAT(frontiers(true, kLayer + 1), IsEmpty());
}

TEST_F(FrontierSlice, GroupsByTheFirstOfEachGroup) {
  const std::vector<FrontierGroup> groups = group_frontiers(frontiers(true), 0.11);
  std::vector<Cells> group_cells;
  for (const FrontierGroup& group : groups) group_cells.push_back(cells(group.points_map_m));
  EXPECT_THAT(group_cells,
              ElementsAre(Cells{{1, 1}, {2, 1}, {3, 1}, {1, 2}, {1, 3}}, Cells{{4, 1}, {5, 1}},
                          Cells{{1, 4}, {2, 4}, {3, 4}}, Cells{{4, 4}, {5, 4}}));
}

}  // namespace
}  // namespace nbvopt
