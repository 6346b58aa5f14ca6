// The cast-ready form of a map against the map itself, and every version against one made anew.
#include "nbvopt/map/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cmath>
#include <thread>
#include <vector>

#include "map/brick_table.hpp"
#include "map/map_access.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/sensor/depth_camera.hpp"
#include "support/camera_pose.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

using detail::BrickBox;
using detail::BrickKey;
using detail::kBrickSize;
using detail::kCodeReach;

/// Where the maps of these tests have something: three bricks an axis, and a margin.
const KeyBox kCluttered = cube(key_from_origin(-40, -40, -40), 80);
const KeyBox kMargin = cube(key_from_origin(-128, -128, -128), 256);

constexpr VoxelKey kStrays[] = {{0, 0, 0},      {65535, 65535, 65535}, {0, 65535, 100},
                                {65535, 0, 31}, {40000, 12, 65535},    {32, 31, 33000}};

/// Clutter, a pruned leaf of 32 voxels and one of 64 in free space, and stray voxels far away.
UncertaintyMap odd_map(std::mt19937_64& random) {
  UncertaintyMap map(0.1);
  scatter(map, kCluttered, 0.05, random);
  set_box(map, cube(key_from_origin(64, -64, 0), 64), kFree);
  set_box(map, cube(key_from_origin(-96, 64, 32), 32), kFree);
  for (const VoxelKey stray : kStrays) map.set(stray, occupied(0.5F));
  map.finish_writing();
  return map;
}

void expect_equals_map(const VoxelGrid& grid, const UncertaintyMap& map, const KeyBox& box) {
  int wrong = 0;
  for_each_key(box, [&](VoxelKey key) {
    const VoxelRecord record = map.at(key);
    wrong += grid.state(key) != record.state || grid.uncertainty(key) != record.uncertainty;
  });
  EXPECT_EQ(wrong, 0) << "voxels";
}

/// States, u and the codes that rays are cast on, brick by brick.
void expect_same_bricks(const VoxelGrid& a, const VoxelGrid& b, const KeyBox& box) {
  detail::bricks_of(box).for_each([&](BrickKey key) {
    const detail::Brick& in_a = *detail::MapAccess::table(a).ready_brick(key);
    const detail::Brick& in_b = *detail::MapAccess::table(b).ready_brick(key);
    EXPECT_EQ(in_a.states->occupied, in_b.states->occupied);
    EXPECT_EQ(in_a.states->free, in_b.states->free);
    EXPECT_EQ(in_a.states->uncertainty, in_b.states->uncertainty);
    EXPECT_EQ(in_a.states->has_occupied, in_b.states->has_occupied);
    EXPECT_EQ(in_a.states->has_free, in_b.states->has_free);
    EXPECT_TRUE(in_a.code == in_b.code) << key.x << ' ' << key.y << ' ' << key.z;
  });
}

/// The hits of full turns of a camera from a few places.
std::vector<RayHits> hits_around(const VoxelGrid& grid) {
  const CameraRays rays = DepthCamera(SensorOptions{}).rays();
  std::vector<RayHits> all;
  for (const double x_m : {-2.0, 0.05, 1.5}) {
    for (int turn = 0; turn < 8; ++turn) {
      cast_rays(
          grid,
          make_bundle(rays, camera_at({x_m, 0.3, -0.2}, turn * 0.8, 0.4 * std::cos(turn)), true),
          1.0, all.emplace_back());
    }
  }
  return all;
}

void expect_same_hits(const VoxelGrid& a, const VoxelGrid& b) {
  const std::vector<RayHits> of_a = hits_around(a);
  const std::vector<RayHits> of_b = hits_around(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    EXPECT_EQ(of_a[i].kind, of_b[i].kind);
    EXPECT_EQ(of_a[i].face, of_b[i].face);
    EXPECT_EQ(of_a[i].voxel, of_b[i].voxel);
    EXPECT_EQ(of_a[i].distance_m, of_b[i].distance_m);
    EXPECT_EQ(of_a[i].uncertainty, of_b[i].uncertainty);
  }
}

TEST(VoxelGrid, HoldsTheMapLazyAndWhole) {
  std::mt19937_64 random(1);
  const UncertaintyMap map = odd_map(random);
  const auto whole = VoxelGrid::whole(map);
  expect_equals_map(*whole, map, kMargin);
  for (const VoxelKey stray : kStrays) {
    expect_equals_map(*whole, map,
                      {key_at(std::max(stray.x - 2, 0), std::max(stray.y - 2, 0), stray.z), stray});
  }

  const auto lazy = VoxelGrid::lazy(map);
  // In parts, so that bricks are read beside bricks that are ready.
  for (int i = 0; i < 40; ++i) {
    const VoxelKey least =
        key_from_origin(uniform_int(random, -128, 64), uniform_int(random, -128, 64),
                        uniform_int(random, -128, 64));
    const KeyBox part = cube(least, uniform_int(random, 1, 63));
    lazy->make_ready(part);
    expect_same_bricks(*lazy, *whole, part);
  }
  lazy->make_ready(kMargin);
  expect_same_bricks(*lazy, *whole, kMargin);
  for (const VoxelKey stray : kStrays) {
    lazy->make_ready({stray, stray});
    expect_same_bricks(*lazy, *whole, {stray, stray});
  }
  EXPECT_EQ(lazy->version(), 1U);
  EXPECT_GT(lazy->memory_bytes(), 0U);
}

TEST(VoxelGrid, KeepsAWholeMapThatIsGone) {
  std::shared_ptr<const VoxelGrid> grid;
  {
    UncertaintyMap map(0.1);
    map.set(key_from_origin(1, 2, 3), occupied(0.25F));
    grid = VoxelGrid::whole(map);
  }
  EXPECT_EQ(grid->state(key_from_origin(1, 2, 3)), VoxelState::occupied);
  EXPECT_EQ(grid->uncertainty(key_from_origin(1, 2, 3)), 0.25F);
}

TEST(VoxelGrid, IsUnknownWhereTheMapIsEmpty) {
  const UncertaintyMap map(0.1);
  for (const auto& grid : {VoxelGrid::lazy(map), VoxelGrid::whole(map)}) {
    grid->make_ready(kMargin);
    EXPECT_EQ(grid->state({0, 1, 2}), VoxelState::unknown);
    EXPECT_EQ(grid->uncertainty(key_from_origin(0, 0, 0)), 1.0F);
    EXPECT_FALSE(grid->has_occupied());
    EXPECT_FALSE(grid->carries_uncertainty());
    EXPECT_FALSE(grid->any_occupied(kMargin));
    EXPECT_FALSE(
        grid->any_known({{Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Ones()}, 0.5}));
  }
}

TEST(VoxelGrid, ReadsTheSurroundingsOfABox) {
  std::mt19937_64 random(7);
  const UncertaintyMap map = odd_map(random);
  const auto whole = VoxelGrid::whole(map);
  const Lattice& lattice = map.lattice();
  const auto brick_keys = detail::brick_keys_of(detail::bricks_of(kMargin));
  int unread = 0;
  int unknown = 0;
  for (int i = 0; i < 100; ++i) {
    const auto lazy = VoxelGrid::lazy(map);
    const Eigen::Vector3d from{uniform(random, -8, 6), uniform(random, -8, 6),
                               uniform(random, -8, 6)};
    const Surroundings near{{from, from + Eigen::Vector3d(uniform(random, 0, 2), 0.0, 1.0)},
                            uniform(random, 0, 3)};
    lazy->make_ready(near);
    bool any_known = false;
    for (const detail::BrickKey& key : brick_keys) {
      const VoxelKey first = key_at(key.x * 32, key.y * 32, key.z * 32);
      const Eigen::Vector3d corner = lattice.centre_m(first).array() - 0.5 * lattice.resolution_m();
      // The nearest points of two boxes, axis by axis.
      const Eigen::Vector3d gap =
          (near.box_map_m.min().array() - corner.array() - 32 * lattice.resolution_m())
              .max(corner.array() - near.box_map_m.max().array())
              .max(0.0);
      if (gap.norm() > near.radius_m) {
        unread += detail::MapAccess::table(*lazy).ready_brick(key) == nullptr;
        continue;
      }
      expect_same_bricks(*lazy, *whole, {first, first});
      any_known |= !detail::MapAccess::table(*whole).ready_brick(key)->states->is_all_unknown();
    }
    EXPECT_EQ(whole->any_known(near), any_known);
    EXPECT_EQ(lazy->any_known(near), any_known);
    unknown += !any_known;
  }
  EXPECT_GT(unread, 1000);
  EXPECT_GT(unknown, 0);
}

TEST(VoxelGrid, KnowsWhatABoxHolds) {
  std::mt19937_64 random(2);
  UncertaintyMap map(0.1);
  std::vector<VoxelKey> occupied_keys(std::begin(kStrays), std::end(kStrays));
  for (int i = 0; i < 300; ++i) {
    occupied_keys.push_back(key_from_origin(
        uniform_int(random, -64, 63), uniform_int(random, -64, 63), uniform_int(random, -64, 63)));
  }
  for (const VoxelKey key : occupied_keys) map.set(key, occupied(0.5F));
  map.finish_writing();
  const auto grid = VoxelGrid::whole(map);

  int holding = 0;
  const auto expect_right = [&](const KeyBox& box) {
    const auto in_box = [](VoxelKey key, const KeyBox& b) {
      return key.x >= b.min.x && key.x <= b.max.x && key.y >= b.min.y && key.y <= b.max.y &&
             key.z >= b.min.z && key.z <= b.max.z;
    };
    const bool any_occupied = std::any_of(occupied_keys.begin(), occupied_keys.end(),
                                          [&](VoxelKey key) { return in_box(key, box); });
    EXPECT_EQ(grid->any_occupied(box), any_occupied);
    holding += any_occupied;
  };
  for (int i = 0; i < 2000; ++i) {
    const auto from_to = [&] {
      const int a = uniform_int(random, -100, 160);
      return std::pair{a, a + uniform_int(random, 0, 60)};
    };
    const auto [x0, x1] = from_to();
    const auto [y0, y1] = from_to();
    const auto [z0, z1] = from_to();
    expect_right({key_from_origin(x0, y0, z0), key_from_origin(x1, y1, z1)});
  }
  EXPECT_GT(holding, 200);
  EXPECT_LT(holding, 1800);
  for (const VoxelKey stray : kStrays) expect_right({stray, stray});
  expect_right({{1, 0, 0}, {5, 40, 40}});
  expect_right({{65500, 65500, 65500}, {65535, 65535, 65535}});
}

/// What a change list must be like: each voxel once.
std::vector<VoxelChange> random_changes(std::mt19937_64& random, int n) {
  std::vector<VoxelChange> changes;
  const auto is_new = [&](VoxelKey key) {
    return std::none_of(changes.begin(), changes.end(),
                        [&](const VoxelChange& change) { return change.key == key; });
  };
  while (static_cast<int>(changes.size()) < n) {
    const VoxelKey key = key_from_origin(uniform_int(random, -70, 70), uniform_int(random, -70, 70),
                                         uniform_int(random, -70, 70));
    if (!is_new(key)) continue;
    const VoxelRecord record = random_voxel(random, 0.7);
    changes.push_back({key, record.state, record.uncertainty});
  }
  return changes;
}

/// A grid made anew from a grid's voxels and the changes.
std::shared_ptr<const VoxelGrid> made_anew(const VoxelGrid& before,
                                           const std::vector<VoxelChange>& changes) {
  UncertaintyMap map(before.lattice().resolution_m());
  const auto write = [&](VoxelKey key, VoxelState state, float uncertainty) {
    if (state == VoxelState::free) map.set(key, kFree);
    if (state == VoxelState::occupied) map.set(key, occupied(uncertainty));
  };
  const auto is_changed = [&](VoxelKey key) {
    return std::any_of(changes.begin(), changes.end(),
                       [&](const VoxelChange& change) { return change.key == key; });
  };
  for_each_key(kMargin, [&](VoxelKey key) {
    const VoxelState state = before.state(key);
    if (state == VoxelState::unknown || is_changed(key)) return;
    write(key, state, before.uncertainty(key));
  });
  for (const VoxelChange& change : changes) write(change.key, change.state, change.uncertainty);
  map.finish_writing();
  return VoxelGrid::whole(map);
}

TEST(VoxelGridUpdate, EqualsAGridMadeAnew) {
  std::mt19937_64 random(3);
  UncertaintyMap map(0.1);
  scatter(map, kCluttered, 0.002, random);
  map.finish_writing();
  std::shared_ptr<const VoxelGrid> grid = VoxelGrid::whole(map);
  for (const int n : {1, 1, 5, 60}) {
    const std::vector<VoxelChange> changes = random_changes(random, n);
    const auto next = grid->updated(changes);
    EXPECT_EQ(next->version(), grid->version() + 1);
    const auto anew = made_anew(*grid, changes);
    expect_same_bricks(*next, *anew, kMargin);
    expect_same_hits(*next, *anew);
    grid = next;
  }
}

TEST(VoxelGridUpdate, LeavesTheOldVersionAsItWas) {
  std::mt19937_64 random(4);
  UncertaintyMap map(0.1);
  scatter(map, kCluttered, 0.01, random);
  map.finish_writing();
  const auto old_version = VoxelGrid::whole(map);
  const auto next = old_version->updated(random_changes(random, 300));
  expect_equals_map(*old_version, map, kMargin);
  expect_same_bricks(*old_version, *VoxelGrid::whole(map), kMargin);
  expect_same_hits(*old_version, *VoxelGrid::whole(map));
  EXPECT_EQ(old_version->version(), 1U);
}

TEST(VoxelGridUpdate, SharesTheBricksThatNoChangeReaches) {
  std::mt19937_64 random(5);
  UncertaintyMap map(0.1);
  scatter(map, kCluttered, 0.01, random);
  map.finish_writing();
  const auto before = VoxelGrid::whole(map);
  const VoxelKey key = key_from_origin(3, 16, 20);
  const VoxelState was = before->state(key);
  const auto shares = [&](const VoxelGrid& after, BrickKey brick) {
    return detail::MapAccess::table(*before).ready_brick(brick) ==
           detail::MapAccess::table(after).ready_brick(brick);
  };
  const BrickBox around = detail::bricks_of(kMargin);

  // Between free and not free, codes change as far as they reach.
  const auto other_state = before->updated(std::vector<VoxelChange>{
      {key, was == VoxelState::free ? VoxelState::occupied : VoxelState::free, 1.0F}});
  around.for_each([&](BrickKey brick) {
    const auto is_near = [](int brick_coordinate, int k) {
      return k + kCodeReach >= brick_coordinate * kBrickSize &&
             k - kCodeReach < (brick_coordinate + 1) * kBrickSize;
    };
    const bool is_reached =
        is_near(brick.x, key.x) && is_near(brick.y, key.y) && is_near(brick.z, key.z);
    if (!is_reached) {
      EXPECT_TRUE(shares(*other_state, brick));
    }
  });
  EXPECT_FALSE(shares(*other_state, detail::brick_of(key)));
}

/// One voxel in wide free space changes codes 16 voxels away, in the next brick or not.
TEST(VoxelGridUpdate, RecodesAsFarAsCodesReach) {
  const KeyBox wide = cube(key_from_origin(-48, -48, -48), 128);
  UncertaintyMap map(0.1);
  set_box(map, wide, kFree);
  map.finish_writing();
  const auto before = VoxelGrid::whole(map);
  for (const int offset : {0, 14, 15, 16, 17, 31}) {
    const VoxelKey key = key_from_origin(offset, offset, offset);
    map.set(key, occupied(1.0F));
    expect_same_bricks(
        *before->updated(std::vector<VoxelChange>{{key, VoxelState::occupied, 1.0F}}),
        *VoxelGrid::whole(map), wide);
    map.set(key, kFree);
  }
}

TEST(VoxelGridUpdate, RecodesNothingForANewUncertainty) {
  UncertaintyMap map(0.1);
  set_box(map, kCluttered, kFree);
  map.set(key_from_origin(0, 0, 0), occupied(0.75F));
  map.finish_writing();
  const auto before = VoxelGrid::whole(map);
  const auto after = before->updated(
      std::vector<VoxelChange>{{key_from_origin(0, 0, 0), VoxelState::occupied, 0.5F}});
  EXPECT_EQ(after->uncertainty(key_from_origin(0, 0, 0)), 0.5F);
  EXPECT_EQ(before->uncertainty(key_from_origin(0, 0, 0)), 0.75F);
  const BrickKey changed = detail::brick_of(key_from_origin(0, 0, 0));
  detail::bricks_of(kMargin).for_each([&](BrickKey brick) {
    EXPECT_EQ(detail::MapAccess::table(*before).ready_brick(brick) ==
                  detail::MapAccess::table(*after).ready_brick(brick),
              brick != changed);
  });
}

TEST(VoxelGridUpdate, MayReachIntoTheUnknownAndBack) {
  const UncertaintyMap nothing(0.1);
  const auto empty = VoxelGrid::whole(nothing);
  std::vector<VoxelChange> changes;
  for (const VoxelKey stray : kStrays) changes.push_back({stray, VoxelState::occupied, 0.5F});
  changes.push_back({key_from_origin(0, 0, 0), VoxelState::free});
  const auto grown = empty->updated(changes);
  EXPECT_TRUE(grown->has_occupied());
  EXPECT_TRUE(grown->carries_uncertainty());
  EXPECT_FALSE(empty->has_occupied());
  for (const VoxelChange& change : changes) {
    EXPECT_EQ(grown->state(change.key), change.state);
    EXPECT_EQ(grown->uncertainty(change.key), change.uncertainty);
    EXPECT_EQ(empty->state(change.key), VoxelState::unknown);
  }
  for (VoxelChange& change : changes) change = {change.key};
  const auto shrunk = grown->updated(changes);
  for (const VoxelChange& change : changes) {
    expect_same_bricks(*shrunk, *empty, {change.key, change.key});
  }
  EXPECT_EQ(shrunk->version(), 3U);
}

TEST(VoxelGridUpdate, FollowsScans) {
  std::mt19937_64 random(6);
  SensorOptions sensor;
  sensor.range_max_m = 3.0;
  UncertaintyMap map(0.1);
  std::shared_ptr<const VoxelGrid> grid = VoxelGrid::whole(map);
  for (int i = 0; i < 6; ++i) {
    Scan scan;
    for (int point = 0; point < 400; ++point) {
      const Eigen::Vector3d direction(uniform(random, -0.5, 0.5), uniform(random, -0.4, 0.4), 1.0);
      const Eigen::Vector3f p = (direction * uniform(random, 0.4, 3.2)).cast<float>();
      (point % 10 == 0 ? scan.no_returns : scan.points_m).push_back(p);
    }
    const InsertResult inserted =
        insert_scan(map, scan, camera_at({0.1 * i, 0.0, 0.0}, 1.1 * i, 0.3 * std::sin(i)), sensor);
    ASSERT_FALSE(inserted.changes.empty());
    grid = grid->updated(inserted.changes);
    const auto anew = VoxelGrid::whole(map);
    expect_equals_map(*grid, map, cube(key_from_origin(-50, -50, -50), 100));
    expect_same_bricks(*grid, *anew, kMargin);
    expect_same_hits(*grid, *anew);
    EXPECT_EQ(grid->carries_uncertainty(), anew->carries_uncertainty());
  }
  EXPECT_EQ(grid->version(), 7U);
}

TEST(VoxelGridUpdate, IsRefusedByALazyGrid) {
  const UncertaintyMap map(0.1);
  EXPECT_THROW(VoxelGrid::lazy(map)->updated({}), UsageError);
}

TEST(VoxelGrid, IsMadeReadyByTwoThreadsAtOnce) {
  std::mt19937_64 random(7);
  UncertaintyMap map(0.1);
  scatter(map, kCluttered, 0.01, random);
  map.finish_writing();
  const auto whole = VoxelGrid::whole(map);
  const std::vector<RayHits> expected = hits_around(*whole);
  for (int repeat = 0; repeat < 10; ++repeat) {
    const auto lazy = VoxelGrid::lazy(map);
    std::barrier start(2);
    std::vector<RayHits> hits;
    std::thread other([&] {
      start.arrive_and_wait();
      lazy->make_ready(kMargin);
    });
    start.arrive_and_wait();
    hits = hits_around(*lazy);  // casting makes ready what it needs
    other.join();
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_EQ(hits[i].voxel, expected[i].voxel);
      EXPECT_EQ(hits[i].kind, expected[i].kind);
    }
    expect_same_bricks(*lazy, *whole, kMargin);
  }
}

}  // namespace
}  // namespace nbvopt::test
