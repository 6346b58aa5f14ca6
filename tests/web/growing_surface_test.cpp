#include "web/growing_surface.hpp"

#include <gmock/gmock.h>

#include "core/json.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A page that keeps what it was sent of each brick.
class Reader {
 public:
  /// Returns the names of the bricks that were sent.
  std::vector<std::string> read(const GrowingSurface& surface) {
    const bool is_whole = !version_ || !surface.knows(*version_);
    if (is_whole) bricks_.clear();
    const SharedBytes members = surface.members(is_whole ? std::nullopt : version_);
    std::vector<std::string> names;
    const Json bricks = parse_json("{" + members.joined() + "}", "bricks");
    for (const auto& [name, packed] : bricks.items()) {
      names.push_back(name);
      if (packed == "") {
        bricks_.erase(name);
      } else {
        bricks_[name] = packed;
      }
    }
    version_ = surface.version();
    return names;
  }

  const std::map<std::string, std::string>& bricks() const { return bricks_; }

 private:
  std::optional<std::uint64_t> version_;
  std::map<std::string, std::string> bricks_;
};

/// The key at voxels from the first brick's first one; bricks begin at multiples of 32.
VoxelKey at(int x, int y = 0, int z = 0) { return key_at(32'000 + x, 32'000 + y, 32'000 + z); }
std::string name(int x, int y = 0, int z = 0) {
  return std::to_string(32'000 + x) + "," + std::to_string(32'000 + y) + "," +
         std::to_string(32'000 + z);
}

VoxelChange change(VoxelKey key, VoxelState state, float uncertainty = 1.0F) {
  return {.key = key, .state = state, .uncertainty = uncertainty};
}

/// Voxels in the middles of four bricks in a row.
UncertaintyMap four_bricks() {
  UncertaintyMap map(0.1);
  for (int brick = 0; brick < 4; ++brick) map.set(at(32 * brick + 16), occupied(0.5F));
  map.finish_writing();
  return map;
}

TEST(GrowingSurface, SendsWhatChangedAlone) {
  auto grid = VoxelGrid::whole(four_bricks());
  GrowingSurface surface;
  surface.show(grid);
  Reader reader;
  EXPECT_THAT(reader.read(surface), ElementsAre(name(0), name(32), name(64), name(96)));
  EXPECT_THAT(reader.read(surface), IsEmpty());

  // In the middle of a brick, and of no other's concern.
  grid = grid->updated(std::vector{change(at(40), VoxelState::free)});
  surface.show(grid);
  EXPECT_THAT(reader.read(surface), ElementsAre(name(32)));

  // A voxel at the end of a brick turns free: that of the next one now faces free space.
  grid = grid->updated(std::vector{change(at(64), VoxelState::occupied)});
  grid = grid->updated(std::vector{change(at(63), VoxelState::free)});
  surface.show(grid);
  EXPECT_THAT(reader.read(surface), ElementsAre(name(32), name(64)));
  const std::string before = reader.bricks().at(name(64));
  grid = grid->updated(std::vector{change(at(63), VoxelState::occupied, 0.25F)});
  surface.show(grid);
  EXPECT_THAT(reader.read(surface), ElementsAre(name(32), name(64)));
  EXPECT_NE(reader.bricks().at(name(64)), before);

  // A grid read anew has other bricks with the same in them.
  surface.forget_grid();
  surface.show(grid->updated({}));
  EXPECT_THAT(reader.read(surface), IsEmpty());
}

TEST(GrowingSurface, MakesTheSameStepByStepAsAtOnce) {
  UncertaintyMap map(0.1);
  std::mt19937_64 random(4);
  scatter(map, cube(at(20, 20, 20), 24), 0.5, random);
  map.finish_writing();
  auto grid = VoxelGrid::whole(map);
  GrowingSurface surface;
  Reader diligent;
  Reader lazy;
  lazy.read(surface);
  std::uniform_int_distribution<int> place(0, 63);
  std::uniform_int_distribution<int> state(0, 2);
  for (int step = 0; step < 30; ++step) {
    surface.show(grid);
    diligent.read(surface);
    if (step % 7 == 0) lazy.read(surface);
    std::vector<VoxelChange> changes;
    for (int i = 0; i < 20; ++i) {
      changes.push_back(change(at(place(random), place(random), place(random)),
                               static_cast<VoxelState>(state(random)), 0.5F));
    }
    grid = grid->updated(changes);
  }
  surface.show(grid);
  GrowingSurface fresh;
  fresh.show(grid);
  Reader expected;
  expected.read(fresh);
  diligent.read(surface);
  lazy.read(surface);
  EXPECT_EQ(diligent.bricks(), expected.bricks());
  EXPECT_EQ(lazy.bricks(), expected.bricks());
  EXPECT_EQ(surface.counts().occupied_voxels, fresh.counts().occupied_voxels);
  EXPECT_EQ(surface.counts().information, fresh.counts().information);
}

TEST(GrowingSurface, TellsWhatIsGoneAndForgetsItWhereThatIsMost) {
  auto grid = VoxelGrid::whole(four_bricks());
  GrowingSurface surface;
  surface.show(grid);
  Reader reader;
  reader.read(surface);
  const std::uint64_t first = surface.version();
  grid = grid->updated(std::vector{change(at(16), VoxelState::unknown)});
  surface.show(grid);
  EXPECT_TRUE(surface.knows(first));
  EXPECT_THAT(reader.read(surface), ElementsAre(name(0)));
  EXPECT_FALSE(reader.bricks().contains(name(0)));
  // Of four bricks three are gone: a reader of before is told all there is.
  grid = grid->updated(
      std::vector{change(at(48), VoxelState::unknown), change(at(80), VoxelState::unknown)});
  surface.show(grid);
  EXPECT_FALSE(surface.knows(first));
  EXPECT_FALSE(surface.knows(surface.version() + 1));
  EXPECT_THAT(reader.read(surface), ElementsAre(name(96)));
  EXPECT_EQ(reader.bricks().size(), 1U);
  EXPECT_EQ(surface.counts().occupied_voxels, 1U);
}

TEST(GrowingSurface, StartsAnewWithVoxelsOfAnotherSize) {
  GrowingSurface surface;
  surface.show(VoxelGrid::whole(four_bricks()));
  UncertaintyMap other(0.2);
  other.set(at(16), occupied(0.5F));
  other.finish_writing();
  surface.show(VoxelGrid::whole(other, 2));
  EXPECT_FALSE(surface.knows(1));
  EXPECT_EQ(surface.counts().occupied_voxels, 1U);
}

TEST(GrowingSurface, CountsAsTheMapDoes) {
  UncertaintyMap map(0.1);
  std::mt19937_64 random(3);
  scatter(map, cube(at(20, 20, 20), 24), 0.5, random);
  map.finish_writing();
  GrowingSurface surface;
  surface.show(VoxelGrid::whole(map));
  const MapCounts expected = map.counts();
  const MapCounts counts = surface.counts();
  EXPECT_EQ(counts.occupied_voxels, expected.occupied_voxels);
  EXPECT_EQ(counts.free_voxels, expected.free_voxels);
  EXPECT_EQ(counts.certain_voxels, expected.certain_voxels);
  EXPECT_NEAR(counts.information, expected.information, 1e-9 * expected.information);
}

}  // namespace
}  // namespace nbvopt::test
