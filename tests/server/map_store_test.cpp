#include "server/map_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <thread>

#include "map/box_clearing.hpp"
#include "nbvopt/solver/registry.hpp"
#include "protocol/limit_error.hpp"
#include "server/server_world.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

MapStore make_store(const ServerLimits& limits = {}, std::uint64_t version = 1) {
  return {test::small_robot(), limits, test::small_map(), version};
}

TEST(MapStore, HoldsTheMapThatScansMakeOfIt) {
  MapStore store = make_store();
  UncertaintyMap expected = test::small_map();
  for (int i = 0; i < 10; ++i) {
    const MapStore::Insertion insertion = store.insert(test::small_scan(), test::scan_pose(i));
    insert_scan(expected, test::small_scan(), test::scan_pose(i), store.robot().sensor);
    EXPECT_EQ(insertion.version, static_cast<std::uint64_t>(i + 2));
    EXPECT_EQ(store.published()->map_version(), insertion.version);
    if (i % 3 == 0) {
      EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot)->bytes.joined(),
                map_file_bytes(expected, MapFormat::uncertainty_ot));
    }
  }
  const auto bytes = store.bytes(MapFormat::uncertainty_ot);
  EXPECT_EQ(bytes->version, 11U);
  EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot), bytes);  // shared while somebody holds it
  EXPECT_EQ(bytes->bytes.joined(), map_file_bytes(expected, MapFormat::uncertainty_ot));

  const auto grid = VoxelGrid::whole(expected);
  const ViewPlanner fresh(grid, store.robot());
  const auto solver = make_solver("auto", {});
  const PlanResult here = store.published()->plan(test::small_request(), *solver);
  const PlanResult there = fresh.plan(test::small_request(), *solver);
  EXPECT_EQ(here.joints, there.joints);
  EXPECT_EQ(here.view, there.view);
  EXPECT_EQ(here.map_version, 11U);
}

TEST(MapStore, PublishesTheMapWithABoxCleared) {
  MapStore store = make_store();
  store.insert(test::small_scan(), test::scan_pose(0));
  store.bytes(MapFormat::uncertainty_ot);  // copies that the clearing makes old
  UncertaintyMap expected = test::small_map();
  insert_scan(expected, test::small_scan(), test::scan_pose(0), store.robot().sensor);
  const KeyBox wall = test::keys_between(expected.lattice(), {0.9, -1.0, 0.0}, {1.2, 0.5, 0.8});
  clear_box(expected, wall);
  EXPECT_EQ(store.clear_box(wall), 3U);
  EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot)->bytes.joined(),
            map_file_bytes(expected, MapFormat::uncertainty_ot));
  const ViewPlanner fresh(VoxelGrid::whole(expected), store.robot());
  EXPECT_EQ(store.published()->evaluate(test::scan_pose(1)), fresh.evaluate(test::scan_pose(1)));
}

TEST(MapStore, KeepsOldVersionsForThoseWhoReadThem) {
  MapStore store = make_store({}, 7);
  const auto before = store.published();
  const ViewGain gain = before->evaluate(test::scan_pose(0));
  store.insert(test::small_scan(), test::scan_pose(0));
  store.clear(0.2);
  EXPECT_EQ(before->map_version(), 7U);
  EXPECT_EQ(before->evaluate(test::scan_pose(0)), gain);
  EXPECT_EQ(store.published()->map_version(), 9U);
  EXPECT_EQ(store.published()->grid()->lattice().resolution_m(), 0.2);
  EXPECT_FALSE(store.published()->grid()->has_occupied());
}

TEST(MapStore, RefusesScansThatStretchTheMapTooFar) {
  ServerLimits limits;
  limits.max_map_extent_m = 10.0;
  MapStore store = make_store(limits);
  Transform far = test::scan_pose(0);
  far.translation().x() += 20.0;
  const std::string before = store.bytes(MapFormat::uncertainty_ot)->bytes.joined();
  EXPECT_THAT(test::message_of<LimitError>([&] { store.insert(test::small_scan(), far); }),
              HasSubstr("max_map_extent_m"));
  EXPECT_EQ(store.published()->map_version(), 1U);
  EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot)->bytes.joined(), before);
  store.insert(test::small_scan(), test::scan_pose(0));  // the refused one did not count
}

TEST(MapStore, RefusesMapsThatAreTooLarge) {
  ServerLimits limits;
  limits.max_map_extent_m = 10.0;
  limits.max_map_mib = 1;
  MapStore store = make_store(limits);
  UncertaintyMap wide(0.1);
  wide.set(test::key_from_origin(0, 0, 0), test::kFree);
  wide.set(test::key_from_origin(200, 0, 0), test::kFree);
  wide.finish_writing();
  EXPECT_THAT(test::message_of<LimitError>([&] { store.replace(std::move(wide)); }),
              HasSubstr("max_map_extent_m"));
  UncertaintyMap dense(0.02);  // a voxel in each of 30 bricks
  for (int brick = 0; brick < 30; ++brick)
    dense.set(test::key_from_origin(32 * (brick % 5), 32 * (brick / 5), 0), test::kFree);
  dense.finish_writing();
  EXPECT_THAT(test::message_of<LimitError>([&] { store.replace(std::move(dense)); }),
              HasSubstr("max_map_mib"));
  EXPECT_THAT(test::message_of<LimitError>([&] { store.clear(0.001); }),
              HasSubstr("min_resolution_m"));
  EXPECT_THAT(test::message_of<LimitError>([&] { store.clear(1e300); }),
              HasSubstr("max_map_extent_m"));
  EXPECT_EQ(store.published()->map_version(), 1U);
}

TEST(MapStore, RefusesScansWhenItIsFull) {
  ServerLimits limits;
  limits.max_map_mib = 80;
  MapStore store(test::small_robot(), limits, UncertaintyMap(0.02), 1);
  int inserted = 0;
  const std::string message = test::message_of<LimitError>([&] {
    for (; inserted < 50; ++inserted) {
      Transform T_map_sensor = test::scan_pose(inserted);
      T_map_sensor.translation().x() += 2.0 * inserted;
      store.insert(test::small_scan(), T_map_sensor);
    }
  });
  EXPECT_THAT(message, HasSubstr("max_map_mib"));
  EXPECT_GT(inserted, 0);
  EXPECT_EQ(store.published()->map_version(), static_cast<std::uint64_t>(inserted + 1));
}

TEST(MapStore, RefusesAScanThatTouchesTooMuch) {
  ServerLimits limits;
  limits.max_map_mib = 8;
  MapStore store(test::small_robot(), limits, UncertaintyMap(0.01), 1);
  const std::string before = store.bytes(MapFormat::uncertainty_ot)->bytes.joined();
  EXPECT_THAT(
      test::message_of<LimitError>([&] { store.insert(test::small_scan(), test::scan_pose(0)); }),
      AllOf(HasSubstr("coarser map"), HasSubstr("the limit is 8 MiB (max_map_mib)")));
  EXPECT_EQ(store.bytes(MapFormat::uncertainty_ot)->bytes.joined(), before);
  EXPECT_EQ(store.published()->map_version(), 1U);
}

TEST(MapStore, HeedsTheCancellationOfAScan) {
  MapStore store = make_store();
  const CancelToken cancel;
  cancel.cancel();
  EXPECT_THROW(store.insert(test::small_scan(), test::scan_pose(0), cancel), CancelledError);
  EXPECT_EQ(store.insert(test::small_scan(), test::scan_pose(0)).version, 2U);
}

TEST(MapStore, RefusesBadScansAndStaysAsItWas) {
  MapStore store = make_store();
  Transform bad = test::scan_pose(0);
  bad.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(store.insert(test::small_scan(), bad), Error);
  EXPECT_EQ(store.published()->map_version(), 1U);
  EXPECT_EQ(store.insert(test::small_scan(), test::scan_pose(0)).version, 2U);
}

TEST(MapStore, CountsWhatItHolds) {
  MapStore store = make_store();
  EXPECT_EQ(store.counts().counts.occupied_voxels, 200U);
  EXPECT_DOUBLE_EQ(store.counts().counts.information, 100.0);
  store.clear({});
  EXPECT_EQ(store.counts().counts.occupied_voxels, 0U);
  EXPECT_EQ(store.counts().version, 2U);
}

/// A map of which every other voxel is known, whose copy takes many slices.
UncertaintyMap scattered_map() {
  UncertaintyMap map(0.1);
  constexpr int kVoxels = 100;
  for (int x = 0; x < kVoxels; ++x) {
    for (int y = 0; y < 2 * kVoxels; ++y) {
      for (int z = x % 2; z < kVoxels; z += 2) map.set(test::key_from_origin(x, y, z), test::kFree);
    }
  }
  map.finish_writing();
  return map;
}

TEST(MapStoreConcurrency, AScanDoesNotWaitForACopy) {
  MapStore store = make_store();
  for (int round = 0; round < 2; ++round) {
    store.replace(scattered_map());
    std::atomic<bool> has_begun{false};
    std::atomic<bool> is_copied{false};
    std::jthread reader([&] {
      has_begun = true;
      EXPECT_GT(store.bytes(MapFormat::uncertainty_ot)->bytes.size(), 10'000'000U);
      is_copied = true;
    });
    while (!has_begun) std::this_thread::yield();
    int scans = 0;
    for (; !is_copied; ++scans) store.insert(test::small_scan(), test::scan_pose(scans));
    EXPECT_GE(scans, 3) << round;
  }
}

/// For the thread sanitizer, too: plans, copies and counts while scans come in.
TEST(MapStoreConcurrency, EveryReaderSeesOneVersion) {
  constexpr int kScans = 40;
  MapStore store = make_store();
  // What each version holds, made one after the other.
  std::vector<ViewGain> expected;
  {
    MapStore alone = make_store();
    expected.push_back(alone.published()->evaluate(test::scan_pose(5)));
    for (int i = 0; i < kScans; ++i) {
      alone.insert(test::small_scan(), test::scan_pose(i));
      expected.push_back(alone.published()->evaluate(test::scan_pose(5)));
    }
  }
  std::atomic<bool> done{false};
  std::atomic<int> read{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&] {
      std::uint64_t last = 0;
      do {
        const auto map = store.published();
        EXPECT_GE(map->map_version(), last);
        last = map->map_version();
        EXPECT_EQ(map->evaluate(test::scan_pose(5)), expected[last - 1]);
        ++read;
      } while (!done);
    });
  }
  readers.emplace_back([&] {
    do {
      const auto bytes = store.bytes(MapFormat::uncertainty_ot);
      std::istringstream in(bytes->bytes.joined());
      EXPECT_GT(read_map(in, "copy").counts().nodes, 0U);
      EXPECT_GE(store.counts().version, bytes->version);
    } while (!done);
  });
  for (int i = 0; i < kScans; ++i) store.insert(test::small_scan(), test::scan_pose(i));
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace nbvopt
