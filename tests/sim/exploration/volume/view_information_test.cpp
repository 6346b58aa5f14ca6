#include "sim/exploration/volume/view_information.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <unordered_set>
#include <vector>

#include "core/uniform.hpp"
#include "sim/exploration/volume/drawn_map.hpp"
#include "sim/exploration/volume/rules.hpp"

namespace nbvopt {
namespace {

constexpr double kVoxel_m = 0.05;
constexpr double kVoxel_m3 = kVoxel_m * kVoxel_m * kVoxel_m;

SensorOptions coarse_camera(int columns, int rows, double range_m) {
  SensorOptions camera;
  camera.ray_pattern = RayPattern::equal_angles;
  camera.horizontal_rays = columns;
  camera.vertical_rays = rows;
  camera.range_max_m = range_m;
  return camera;
}

/// The unknown voxels that the rays cross, by marching to the middle of every piece of a ray
/// between two faces of voxels.
std::uint64_t crossed_unknown(const VoxelGrid& grid, const SensorOptions& camera,
                              const Transform& T_map_sensor) {
  const CameraRays rays = DepthCamera(camera).rays();
  std::unordered_set<std::uint64_t> seen;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d direction = T_map_sensor.linear() * rays.direction(i);
    const Eigen::Vector3d origin = T_map_sensor.translation();
    std::vector<double> faces_m{0.0, camera.range_max_m};
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = -200; k <= 200; ++k) {
        const double t_m = (k * kVoxel_m - origin[axis]) / direction[axis];
        if (t_m > 0.0 && t_m < camera.range_max_m) faces_m.push_back(t_m);
      }
    }
    std::ranges::sort(faces_m);
    for (std::size_t face = 1; face < faces_m.size(); ++face) {
      const VoxelKey key =
          grid.lattice().key(origin + 0.5 * (faces_m[face - 1] + faces_m[face]) * direction);
      if (grid.state(key) == VoxelState::occupied) break;
      if (grid.state(key) == VoxelState::unknown) seen.insert(packed(key));
    }
  }
  return seen.size();
}

TEST(ViewInformation, CountsWhatMarchingCounts) {
  std::mt19937_64 random(3);
  UncertaintyMap map(kVoxel_m);
  for (int z = -20; z < 20; ++z) {
    for (int y = -20; y < 20; ++y) {
      for (int x = -20; x < 20; ++x) {
        const double chance = uniform(random);
        test::set_state(map, test::key_at(x, y, z),
                        chance < 0.01  ? VoxelState::occupied
                        : chance < 0.5 ? VoxelState::free
                                       : VoxelState::unknown);
      }
    }
  }
  map.finish_writing();
  const auto grid = VoxelGrid::whole(map);
  const SensorOptions camera = coarse_camera(21, 13, 1.7);
  ViewInformation information(camera);
  for (const double yaw_rad : {0.0, 0.4, 1.9, 3.3, 5.0}) {
    Transform T_map_sensor = base_pose(0.013, -0.027, 0.11, yaw_rad);
    T_map_sensor.linear() *= rotation_body_sensor();
    const double expected_m3 =
        kVoxel_m3 * static_cast<double>(crossed_unknown(*grid, camera, T_map_sensor));
    EXPECT_GT(expected_m3, 0.05);
    EXPECT_NEAR(information.volume_m3(*grid, T_map_sensor), expected_m3, 1e-9);
    // Nothing is left over from the view before.
    EXPECT_NEAR(information.volume_m3(*grid, T_map_sensor), expected_m3, 1e-9);
  }
}

TEST(ViewInformation, OfARayIsItsUnknownVoxels) {
  const UncertaintyMap map = test::drawn_layer({".??.?#??????"}, 0);
  const auto grid = VoxelGrid::whole(map);
  Transform T_map_sensor = base_pose(0.02, 0.02, 0.02, 0.0);
  T_map_sensor.linear() *= rotation_body_sensor();
  // Three before the wall, whatever is behind it; two in a range of 0.2 m.
  EXPECT_NEAR(ViewInformation(coarse_camera(1, 1, 1.0)).volume_m3(*grid, T_map_sensor),
              3 * kVoxel_m3, 1e-12);
  EXPECT_NEAR(ViewInformation(coarse_camera(1, 1, 0.55)).volume_m3(*grid, T_map_sensor),
              3 * kVoxel_m3, 1e-12);
}

TEST(ViewInformation, EndsWhereTheLatticeDoes) {
  UncertaintyMap map(kVoxel_m);
  map.set(test::key_at(-2, -2, -2), {.state = VoxelState::free, .log_odds = -1.0F});
  map.finish_writing();
  Transform T_map_sensor = base_pose(1637.99, 0.02, 0.02, 0.0);  // the lattice ends at 1,638.4 m
  T_map_sensor.linear() *= rotation_body_sensor();
  EXPECT_NEAR(
      ViewInformation(coarse_camera(1, 1, 3.0)).volume_m3(*VoxelGrid::whole(map), T_map_sensor),
      9 * kVoxel_m3, 1e-12);
}

TEST(ViewInformation, OfAnEmptyMapIsAboutTheViewsVolume) {
  UncertaintyMap map(kVoxel_m);
  map.set(test::key_at(0, 0, 0), {.state = VoxelState::free, .log_odds = -1.0F});
  map.finish_writing();
  const SensorOptions camera = rules_of(VolumeExplorer::bai2016).camera;
  Transform T_map_sensor = base_pose(0.01, 0.01, 0.01, 0.7);
  T_map_sensor.linear() *= rotation_body_sensor();
  const double solid_angle = 4.0 * std::asin(std::sin(camera.half_fov_horizontal_rad) *
                                             std::sin(camera.half_fov_vertical_rad));
  const double volume_m3 = solid_angle * std::pow(camera.range_max_m, 3) / 3.0;
  const double counted_m3 = ViewInformation(camera).volume_m3(*VoxelGrid::whole(map), T_map_sensor);
  EXPECT_NEAR(counted_m3 / volume_m3, 1.0, 0.1);
}

}  // namespace
}  // namespace nbvopt
