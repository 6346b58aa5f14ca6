#include "nbvopt/map/shared_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "nbvopt/core/error.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

const VoxelKey kSeen = key_from_origin(0, 0, 20);

/// One point two metres ahead of a camera at the origin that looks up.
Scan point_ahead() {
  return {.points_m = {{0.01F, 0.01F, 2.01F}}, .colours = {}, .no_returns = {}};
}

UncertaintyMap free_voxels() {
  UncertaintyMap map(0.1);
  set_box(map, cube(key_from_origin(-4, -4, -4), 60), kFree);
  map.finish_writing();
  return map;
}

TEST(SharedMap, HasOneGridThatFillsAsItIsUsed) {
  const SharedMap map(free_voxels());
  const auto grid = map.grid();
  EXPECT_EQ(grid, map.grid());
  EXPECT_EQ(grid->version(), 1U);
  const std::size_t unread = grid->memory_bytes();
  grid->make_ready({kSeen, kSeen});
  EXPECT_GT(grid->memory_bytes(), unread);
}

TEST(SharedMap, FollowsItsScansAndKeepsOldVersions) {
  SharedMap map(free_voxels());
  const auto before = map.grid();  // none of its bricks is read yet
  UncertaintyMap alone = free_voxels();
  for (std::uint64_t version = 2; version < 5; ++version) {
    const InsertResult expected = insert_scan(alone, point_ahead(), Transform::Identity(), {});
    const InsertResult inserted = map.insert(point_ahead(), Transform::Identity(), {});
    EXPECT_EQ(inserted.points_used, expected.points_used);
    EXPECT_EQ(inserted.changes.size(), expected.changes.size());
    EXPECT_EQ(map.grid()->version(), version);
  }
  EXPECT_EQ(map.map().at(kSeen).uncertainty, alone.at(kSeen).uncertainty);
  EXPECT_EQ(map.grid()->state(kSeen), VoxelState::occupied);
  EXPECT_EQ(map.grid()->uncertainty(kSeen), alone.at(kSeen).uncertainty);
  EXPECT_EQ(before->state(kSeen), VoxelState::free);
}

TEST(SharedMap, MakesTheGridOfWhatItHasBecome) {
  SharedMap map(free_voxels());
  map.insert(point_ahead(), Transform::Identity(), {});
  map.insert(point_ahead(), Transform::Identity(), {});
  EXPECT_EQ(map.grid()->version(), 3U);
  EXPECT_EQ(map.grid()->state(kSeen), VoxelState::occupied);
}

TEST(SharedMap, IsAsBeforeWhereAScanIsRefused) {
  SharedMap map(free_voxels());
  const auto before = map.grid();
  Transform nowhere = Transform::Identity();
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(map.insert(point_ahead(), nowhere, {}), InputError);
  EXPECT_EQ(map.grid(), before);
  map.insert(point_ahead(), Transform::Identity(), {});
  EXPECT_EQ(map.grid()->version(), 2U);
}

}  // namespace
}  // namespace nbvopt::test
