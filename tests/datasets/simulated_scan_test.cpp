#include "simulated_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/camera_pose.hpp"

namespace nbvopt {
namespace {

constexpr double kMapResolution_m = 0.1;

SensorOptions small_sensor() {
  SensorOptions sensor;
  sensor.horizontal_pixels = 24;
  sensor.vertical_pixels = 18;
  return sensor;
}

/// A camera in the middle of a voxel that looks along map x.
Transform looking_along_x() { return test::camera_at(Eigen::Vector3d::Constant(0.05)); }

/// Free space within 6 m of the origin; where x >= wall_x_m, a wall.
std::shared_ptr<const VoxelGrid> world_with_wall(double wall_x_m) {
  UncertaintyMap map(kMapResolution_m);
  const VoxelKey min = map.lattice().key({-1.0, -4.0, -4.0});
  const VoxelKey max = map.lattice().key({6.0, 4.0, 4.0});
  for (std::uint16_t x = min.x; x <= max.x; ++x) {
    for (std::uint16_t y = min.y; y <= max.y; ++y) {
      for (std::uint16_t z = min.z; z <= max.z; ++z) {
        const bool wall = map.lattice().centre_m({x, y, z}).x() >= wall_x_m;
        map.set({x, y, z}, {.state = wall ? VoxelState::occupied : VoxelState::free,
                            .log_odds = wall ? 3.5F : -2.0F});
      }
    }
  }
  map.finish_writing();
  return VoxelGrid::whole(map);
}

TEST(SimulatedScan, EveryPixelReturnsFromAWallInRange) {
  const SensorOptions sensor = small_sensor();
  const Scan scan = simulate_scan(*world_with_wall(2.0), sensor, looking_along_x());
  ASSERT_EQ(scan.points_m.size(), std::size_t(sensor.horizontal_pixels * sensor.vertical_pixels));
  EXPECT_TRUE(scan.no_returns.empty());
  for (const Eigen::Vector3f& p_sensor_m : scan.points_m) {
    // The wall's face is at x = 2.0: 1.95 m before the camera, the return just behind it.
    EXPECT_GT(p_sensor_m.z(), 1.95F);
    EXPECT_LT(p_sensor_m.z(), 1.9502F);
  }
}

TEST(SimulatedScan, NothingReturnsFromAWallBeyondTheRange) {
  const SensorOptions sensor = small_sensor();
  const Scan scan = simulate_scan(*world_with_wall(5.0), sensor, looking_along_x());
  EXPECT_TRUE(scan.points_m.empty());
  EXPECT_EQ(scan.no_returns.size(), std::size_t(sensor.horizontal_pixels * sensor.vertical_pixels));
}

TEST(SimulatedScan, AnUnknownWorldGivesNoReturns) {
  const UncertaintyMap nothing(kMapResolution_m);
  const Scan scan = simulate_scan(*VoxelGrid::whole(nothing), small_sensor(), looking_along_x());
  EXPECT_TRUE(scan.points_m.empty());
  EXPECT_FALSE(scan.no_returns.empty());
}

TEST(SimulatedScan, AWallNearerThanTheRangeSaysNothing) {
  const Scan scan = simulate_scan(*world_with_wall(0.2), small_sensor(), looking_along_x());
  EXPECT_TRUE(scan.points_m.empty());
  EXPECT_TRUE(scan.no_returns.empty());
}

}  // namespace
}  // namespace nbvopt
