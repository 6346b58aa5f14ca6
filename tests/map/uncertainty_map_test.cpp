#include "nbvopt/map/uncertainty_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr VoxelRecord kFree{.state = VoxelState::free, .log_odds = -1.0F};

VoxelRecord occupied(float uncertainty) {
  return {.state = VoxelState::occupied, .log_odds = 2.0F, .uncertainty = uncertainty};
}

void set_cube(UncertaintyMap& map, VoxelKey least, int size, const VoxelRecord& record) {
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      for (int z = 0; z < size; ++z) {
        map.set({static_cast<std::uint16_t>(least.x + x), static_cast<std::uint16_t>(least.y + y),
                 static_cast<std::uint16_t>(least.z + z)},
                record);
      }
    }
  }
}

TEST(UncertaintyMap, RefusesAResolutionThatIsNone) {
  for (const double resolution_m : {0.0, -0.1, std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(UncertaintyMap map(resolution_m), InputError) << resolution_m;
  }
}

TEST(UncertaintyMap, IsUnknownWhenEmpty) {
  const UncertaintyMap map(0.1);
  EXPECT_EQ(map.at({1, 2, 3}).state, VoxelState::unknown);
  EXPECT_EQ(map.at({1, 2, 3}).uncertainty, 1.0F);
  EXPECT_EQ(map.known_box(), std::nullopt);
  EXPECT_EQ(map.counts().nodes, 0U);
  EXPECT_FALSE(map.carries_uncertainty());
}

TEST(UncertaintyMap, GivesBackWhatWasSet) {
  UncertaintyMap map(0.1);
  VoxelRecord record = occupied(0.25F);
  record.colour = {1, 2, 3};
  map.set({32768, 40000, 65535}, record);
  map.set({0, 0, 0}, kFree);
  map.finish_writing();

  const VoxelRecord read = map.at({32768, 40000, 65535});
  EXPECT_EQ(read.state, VoxelState::occupied);
  EXPECT_EQ(read.log_odds, 2.0F);
  EXPECT_EQ(read.uncertainty, 0.25F);
  EXPECT_EQ(read.colour, record.colour);
  EXPECT_EQ(map.at({0, 0, 0}).state, VoxelState::free);
  EXPECT_EQ(map.at({0, 0, 1}).state, VoxelState::unknown);
  EXPECT_EQ(map.known_box(), (KeyBox{{0, 0, 0}, {32768, 40000, 65535}}));
  EXPECT_TRUE(map.carries_uncertainty());
}

TEST(UncertaintyMap, KeepsUncertaintyForOccupiedVoxelsOnly) {
  UncertaintyMap map(0.1);
  VoxelRecord record = kFree;
  record.uncertainty = 0.5F;
  map.set({5, 5, 5}, record);
  EXPECT_EQ(map.at({5, 5, 5}).uncertainty, 1.0F);
}

TEST(UncertaintyMap, PrunesOnlyWhereAllIsEqual) {
  VoxelRecord other_colour = occupied(0.25F);
  other_colour.colour = {1, 2, 3};
  VoxelRecord other_log_odds = occupied(0.25F);
  other_log_odds.log_odds = 1.0F;
  for (const VoxelRecord& odd : {occupied(0.5F), other_colour, other_log_odds}) {
    UncertaintyMap map(0.1);
    set_cube(map, {64, 64, 64}, 4, occupied(0.25F));
    map.finish_writing();
    EXPECT_EQ(map.counts().leaves, 1U);
    EXPECT_EQ(map.counts().occupied_voxels, 64U);

    map.set({65, 66, 67}, odd);
    map.finish_writing();
    EXPECT_EQ(map.counts().leaves, 15U) << "7 cubes of two voxels, 8 voxels";
    EXPECT_EQ(map.counts().occupied_voxels, 64U);

    map.set({65, 66, 67}, occupied(0.25F));
    map.finish_writing();
    EXPECT_EQ(map.counts().leaves, 1U);
  }
}

TEST(UncertaintyMap, CountsInnerNodesAsThePaperDoes) {
  UncertaintyMap map(0.1);
  EXPECT_EQ(map.paper_counts().voxels, 0U);
  set_cube(map, {64, 64, 64}, 4, occupied(0.25F));
  map.finish_writing();
  EXPECT_EQ(map.paper_counts().voxels, 15U) << "one leaf of 64 voxels, 14 inner nodes above it";
  EXPECT_DOUBLE_EQ(map.paper_counts().information, 15 * 0.75);

  map.set({68, 64, 64}, kFree);  // in the leaf's neighbour: the nodes above both hold u = 1
  map.finish_writing();
  EXPECT_EQ(map.paper_counts().voxels, 1U);
}

TEST(UncertaintyMap, WritesOneVoxelOfAPrunedLeafAndNoOther) {
  UncertaintyMap map(0.1);
  set_cube(map, {64, 64, 64}, 8, occupied(0.25F));
  map.finish_writing();
  map.set({70, 69, 68}, kFree);
  map.finish_writing();
  for (std::uint16_t x = 64; x < 72; ++x) {
    for (std::uint16_t y = 64; y < 72; ++y) {
      for (std::uint16_t z = 64; z < 72; ++z) {
        const bool is_written = x == 70 && y == 69 && z == 68;
        EXPECT_EQ(map.at({x, y, z}).state, is_written ? VoxelState::free : VoxelState::occupied);
        EXPECT_EQ(map.at({x, y, z}).uncertainty, is_written ? 1.0F : 0.25F);
      }
    }
  }
}

TEST(UncertaintyMap, HoldsTheMaximaOfChildrenInInnerNodes) {
  UncertaintyMap map(0.1);
  map.set({32768, 32768, 32768}, occupied(0.25F));
  map.set({32769, 32768, 32768}, occupied(0.75F));
  VoxelRecord strong = occupied(0.5F);
  strong.log_odds = 3.0F;
  map.set({32770, 32768, 32768}, strong);
  map.finish_writing();
  EXPECT_EQ(detail::MapAccess::tree(map).getRoot()->getLogOdds(), 3.0F);
  EXPECT_EQ(detail::MapAccess::tree(map).getRoot()->uncertainty(), 0.75F);
}

/// Equations (10) and (11) over leaves of several sizes.
TEST(UncertaintyMap, CountsVoxelsAndInformation) {
  UncertaintyMap map(0.1);
  set_cube(map, {64, 64, 64}, 4, occupied(0.25F));
  set_cube(map, {128, 64, 64}, 2, kFree);
  map.set({200, 1, 1}, occupied(1.0F));
  map.set({210, 1, 1}, occupied(0.5F));
  map.finish_writing();
  const MapCounts counts = map.counts();
  EXPECT_EQ(counts.occupied_voxels, 66U);
  EXPECT_EQ(counts.free_voxels, 8U);
  EXPECT_EQ(counts.certain_voxels, 65U);
  EXPECT_EQ(counts.information, 64 * 0.75 + 0.5);
  EXPECT_EQ(counts.leaves, 4U);
  EXPECT_EQ(counts.nodes, detail::MapAccess::tree(map).calcNumNodes());
}

TEST(UncertaintyMap, KnowsTheLeastBoxOfWhatItKnows) {
  UncertaintyMap map(0.1);
  set_cube(map, {64, 64, 64}, 4, kFree);
  map.finish_writing();
  EXPECT_EQ(map.known_box(), (KeyBox{{64, 64, 64}, {67, 67, 67}}));
  map.set({60, 66, 90}, kFree);
  map.finish_writing();
  EXPECT_EQ(map.known_box(), (KeyBox{{60, 64, 64}, {67, 67, 90}}));
}

TEST(UncertaintyMap, MayBeMoved) {
  UncertaintyMap map(0.1);
  map.set({1, 2, 3}, occupied(0.5F));
  UncertaintyMap other = std::move(map);
  EXPECT_EQ(other.at({1, 2, 3}).state, VoxelState::occupied);
}

}  // namespace
}  // namespace nbvopt
