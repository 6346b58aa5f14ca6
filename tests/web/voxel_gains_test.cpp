#include "web/voxel_gains.hpp"

#include <gmock/gmock.h>

#include <set>

#include "nbvopt/gain/view_evaluator.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// The camera in the middle of a cube of random voxels, in a free space of its own.
UncertaintyMap cluttered_map() {
  UncertaintyMap map(0.1);
  std::mt19937_64 random(3);
  scatter(map, cube(key_from_origin(-20, -20, -20), 41), 0.02, random);
  set_box(map, cube(key_from_origin(-6, -6, -6), 13), kFree);
  map.finish_writing();
  return map;
}

TEST(VoxelGains, AddUpToTheViews) {
  const UncertaintyMap map = cluttered_map();
  const auto grid = VoxelGrid::whole(map);
  Transform T_map_sensor = base_pose(0.03, 0.02, 0.05, 0.4);
  T_map_sensor.linear() *= rotation_body_sensor();
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    SensorOptions sensor;
    sensor.counting = counting;
    sensor.normal_weight = 0.25;
    const ViewGain view = make_exact_evaluator(grid, DepthCamera(sensor))->evaluate(T_map_sensor);
    double unknown = 0.0;
    double occupied_sum = 0.0;
    std::set<std::uint64_t> voxels;
    for (const VoxelGain& voxel : voxel_gains(*grid, sensor, T_map_sensor)) {
      EXPECT_TRUE(voxels.insert(packed(voxel.key)).second);
      EXPECT_EQ(voxel.kind == HitKind::occupied, map.at(voxel.key).state == VoxelState::occupied);
      EXPECT_GT(voxel.gain, 0.0);
      (voxel.kind == HitKind::occupied ? occupied_sum : unknown) += voxel.gain;
    }
    EXPECT_GT(view.unknown_gain, 10.0);
    EXPECT_GT(view.occupied_gain, 1.0);
    EXPECT_NEAR(unknown, view.unknown_gain, 1e-9 * view.gain);
    EXPECT_NEAR(occupied_sum, view.occupied_gain, 1e-9 * view.gain);
  }
}

}  // namespace
}  // namespace nbvopt::test
