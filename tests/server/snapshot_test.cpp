#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "server/server_world.hpp"
#include "server/snapshot_file.hpp"
#include "server/snapshot_keeper.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"
#include "support/wait_until.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

class SnapshotTest : public ::testing::Test {
 protected:
  test::TemporaryFolder folder;
  const std::string path = folder / "snapshot.ot";
  MapStore store{test::small_robot(), ServerLimits{}, test::small_map(), 5};
};

TEST_F(SnapshotTest, KeepsMapAndVersion) {
  const auto map = store.bytes(MapFormat::uncertainty_ot);
  write_snapshot(path, *map);
  const auto snapshot = read_snapshot(path);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->version, 5U);
  EXPECT_EQ(map_file_bytes(snapshot->map, MapFormat::uncertainty_ot), map->bytes.joined());
  EXPECT_EQ(map_file_bytes(read_map(fs::path(path)), MapFormat::uncertainty_ot),
            map->bytes.joined());
}

TEST_F(SnapshotTest, KeepsWhatScansTaughtAnExpectedGain) {
  write_snapshot(path, *store.bytes(MapFormat::uncertainty_ot));
  EXPECT_FALSE(read_snapshot(path)->hazards) << "a robot whose gain is not expected learns none";
  EXPECT_THAT(test::message_of<InputError>([&] { read_hazards(path); }),
              HasSubstr("this map keeps no hazards"));

  Robot robot = test::small_robot();
  robot.sensor.gain = GainKind::expected;
  MapStore learning(robot, ServerLimits{}, UncertaintyMap(0.1), 1);
  learning.insert(test::small_scan(), test::scan_pose(0));
  const HazardTable taught = learning.published()->hazards();
  ASSERT_NE(taught, HazardTable());
  const auto map = learning.bytes(MapFormat::uncertainty_ot);
  write_snapshot(path, *map);
  const auto snapshot = read_snapshot(path);
  EXPECT_EQ(snapshot->version, 2U);
  EXPECT_EQ(snapshot->hazards, taught);
  EXPECT_EQ(read_hazards(path), taught);
  EXPECT_EQ(map_file_bytes(snapshot->map, MapFormat::uncertainty_ot), map->bytes.joined());
}

TEST_F(SnapshotTest, KeepsCountsOfManyDigits) {
  MapBytes map = *store.bytes(MapFormat::uncertainty_ot);
  map.hazards = HazardTable(0.1 / 3.0);
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) {
    map.hazards->set(c, {.hits = 100.0 / 3.0, .metres = 1000.0 / 7.0});
  }
  write_snapshot(path, map);
  const auto snapshot = read_snapshot(path);
  EXPECT_EQ(snapshot->hazards, map.hazards);
  EXPECT_EQ(map_file_bytes(snapshot->map, MapFormat::uncertainty_ot), map.bytes.joined());
}

TEST_F(SnapshotTest, MayBeAnyMapFileOrNone) {
  EXPECT_FALSE(read_snapshot(path));
  write_map(test::small_map(), path, MapFormat::uncertainty_ot);
  EXPECT_EQ(read_snapshot(path)->version, 1U);
  folder.write("snapshot.ot", "not a map");
  EXPECT_THROW(read_snapshot(path), InputError);
}

TEST_F(SnapshotTest, RemovesWhatKilledWritersLeft) {
  folder.write("snapshot.ot.nbvopt-unfinished-12-3", "half");
  for (const char* mine : {"snapshot.ot", "snapshot.ot.backup", "snapshot.ot.lock",
                           "other.ot.nbvopt-unfinished-1-1"}) {
    folder.write(mine, "mine");
  }
  fs::create_symlink(path, folder / "link.ot");
  remove_unfinished_files(folder / "link.ot");
  EXPECT_FALSE(fs::exists(folder / "snapshot.ot.nbvopt-unfinished-12-3"));
  EXPECT_TRUE(fs::exists(folder / "snapshot.ot.backup"));
  EXPECT_TRUE(fs::exists(folder / "snapshot.ot.lock"));
  EXPECT_TRUE(fs::exists(folder / "other.ot.nbvopt-unfinished-1-1"));
}

TEST_F(SnapshotTest, KeeperSavesWhatChanged) {
  SnapshotKeeper keeper(store, path, 1h);
  EXPECT_EQ(keeper.state().durable_version, 0U);
  keeper.save();
  EXPECT_EQ(keeper.state().durable_version, 5U);
  folder.write("snapshot.ot", "untouched");
  keeper.save();  // nothing changed since
  EXPECT_EQ(read_text_file(path), "untouched");
  fs::remove(path);
  keeper.save();  // somebody removed it
  EXPECT_EQ(read_snapshot(path)->version, 5U);
  store.insert(test::small_scan(), test::scan_pose(0));
  keeper.save();
  EXPECT_EQ(keeper.state().durable_version, 6U);
  EXPECT_EQ(read_snapshot(path)->version, 6U);
}

TEST_F(SnapshotTest, KeeperSavesByItself) {
  SnapshotKeeper keeper(store, path, 1ms);
  EXPECT_TRUE(test::wait_until([&] { return keeper.state().durable_version == 5; }));
  EXPECT_EQ(read_snapshot(path)->version, 5U);
}

TEST_F(SnapshotTest, KeeperTellsWhatFailedAndTriesAgain) {
  SnapshotKeeper keeper(store, folder / "none/snapshot.ot", 1h);
  EXPECT_THROW(keeper.save(), InputError);
  EXPECT_EQ(keeper.state().durable_version, 0U);
  EXPECT_THAT(keeper.state().error, testing::HasSubstr("no folder"));
  fs::create_directory(folder / "none");
  keeper.save();
  EXPECT_EQ(keeper.state().error, "");
  EXPECT_EQ(keeper.state().durable_version, 5U);
}

TEST_F(SnapshotTest, DurableVersionsAreOnDiskWhileScansComeIn) {
  SnapshotKeeper keeper(store, path, 1ms);
  for (int i = 0; i < 50; ++i) {
    store.insert(test::small_scan(), test::scan_pose(i));
    const std::uint64_t durable = keeper.state().durable_version;
    if (durable > 0) {
      EXPECT_GE(read_snapshot(path)->version, durable);
    }
  }
}

}  // namespace
}  // namespace nbvopt
