#include "map/box_clearing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/made_map.hpp"

namespace nbvopt {
namespace {

TEST(BoxClearing, MakesWhatIsKnownFree) {
  UncertaintyMap map(0.1);
  const KeyBox block = test::cube(test::key_from_origin(-20, -20, -20), 40);  // pruned in part
  test::set_box(map, block, test::occupied(0.25F));
  map.finish_writing();
  const KeyBox box{test::key_from_origin(0, 0, 0), test::key_from_origin(30, 30, 30)};
  const BoxClearing clearing = clear_box(map, box);
  EXPECT_EQ(clearing.changes.size(), 20U * 20U * 20U);  // the box holds unknown voxels, too
  EXPECT_EQ(clearing.tiles.size(), 1U);
  const auto is_in_box = [](VoxelKey key) {
    const int origin = Lattice::kKeyOfOrigin;
    return key.x >= origin && key.y >= origin && key.z >= origin;
  };
  test::for_each_key(block, [&](VoxelKey key) {
    const VoxelState expected = is_in_box(key) ? VoxelState::free : VoxelState::occupied;
    ASSERT_EQ(map.at(key).state, expected);
  });
  EXPECT_EQ(map.counts().free_voxels, 8000U);
  EXPECT_EQ(map.counts().occupied_voxels, 64'000U - 8000U);
  EXPECT_TRUE(clear_box(map, box).changes.empty());
}

TEST(BoxClearing, IsBounded) {
  UncertaintyMap map(0.1);
  map.set(test::key_from_origin(0, 0, 0), test::kFree);
  map.finish_writing();
  const KeyBox all{test::key_at(0, 0, 0), test::key_at(0xFFFF, 0xFFFF, 0xFFFF)};
  EXPECT_TRUE(clear_box(map, all).changes.empty());  // as far as it is known
  test::set_box(map, test::cube(test::key_from_origin(0, 0, 0), 8), test::occupied(0.5F));
  map.finish_writing();
  EXPECT_EQ(clear_box(map, all).changes.size(), 512U);
}

}  // namespace
}  // namespace nbvopt
