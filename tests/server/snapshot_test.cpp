#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "server/server_world.hpp"
#include "server/snapshot_file.hpp"
#include "server/snapshot_keeper.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class SnapshotTest : public ::testing::Test {
 protected:
  test::TemporaryFolder folder;
  const std::string path = folder / "snapshot.ot";
  MapStore store{test::small_robot(), ServerLimits{}, test::small_map(), 5};
};

TEST_F(SnapshotTest, KeepsMapAndVersion) {
  const MapBytes map = store.bytes(MapFormat::uncertainty_ot);
  write_snapshot(path, map);
  const auto snapshot = read_snapshot(path);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->version, 5U);
  EXPECT_EQ(map_file_bytes(snapshot->map, MapFormat::uncertainty_ot), map.bytes);
  EXPECT_EQ(map_file_bytes(read_map(fs::path(path)), MapFormat::uncertainty_ot), map.bytes);
}

TEST_F(SnapshotTest, MayBeAnyMapFileOrNone) {
  EXPECT_FALSE(read_snapshot(path));
  write_map(test::small_map(), path, MapFormat::uncertainty_ot);
  EXPECT_EQ(read_snapshot(path)->version, 1U);
  folder.write("snapshot.ot", "not a map");
  EXPECT_THROW(read_snapshot(path), InputError);
}

TEST_F(SnapshotTest, RemovesWhatKilledWritersLeft) {
  folder.write("snapshot.ot.aB3xYz", "half");
  folder.write("snapshot.ot.backup1", "mine");
  folder.write("snapshot.ot.lock", "");
  remove_unfinished_snapshots(path);
  EXPECT_FALSE(fs::exists(folder / "snapshot.ot.aB3xYz"));
  EXPECT_TRUE(fs::exists(folder / "snapshot.ot.backup1"));
  EXPECT_TRUE(fs::exists(folder / "snapshot.ot.lock"));
}

TEST_F(SnapshotTest, KeeperSavesWhatChanged) {
  SnapshotKeeper keeper(store, path, 1h);
  EXPECT_EQ(keeper.state().durable_version, 0U);
  keeper.save();
  EXPECT_EQ(keeper.state().durable_version, 5U);
  fs::remove(path);
  keeper.save();  // nothing changed since
  EXPECT_FALSE(fs::exists(path));
  store.insert(test::small_scan(), test::scan_pose(0));
  keeper.save();
  EXPECT_EQ(keeper.state().durable_version, 6U);
  EXPECT_EQ(read_snapshot(path)->version, 6U);
}

TEST_F(SnapshotTest, KeeperSavesByItself) {
  SnapshotKeeper keeper(store, path, 1ms);
  for (int i = 0; i < 10'000 && keeper.state().durable_version < 5; ++i) {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(keeper.state().durable_version, 5U);
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
