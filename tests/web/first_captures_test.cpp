#include "web/first_captures.hpp"

#include <gmock/gmock.h>

#include <array>

#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// Free for 3 m in x with a wall at each end.
UncertaintyMap corridor() {
  UncertaintyMap map(0.1);
  set_box(map, {key_from_origin(-15, -10, -10), key_from_origin(15, 10, 10)}, kFree);
  for (const int x : {-15, 15}) {
    set_box(map, {key_from_origin(x, -10, -10), key_from_origin(x, 10, 10)}, occupied(0.5F));
  }
  map.finish_writing();
  return map;
}

Transform looking_along(double yaw_rad) {
  Transform T_map_sensor = base_pose(0.05, 0.05, 0.05, yaw_rad);
  T_map_sensor.linear() *= rotation_body_sensor();
  return T_map_sensor;
}

TEST(FirstCaptures, AreThoseThatSawAVoxelFirst) {
  const UncertaintyMap map = corridor();
  constexpr double kBack = 3.14159265358979;
  const std::array poses{looking_along(0.0), looking_along(kBack), looking_along(0.0)};
  const auto first = first_captures(*VoxelGrid::whole(map), SensorOptions{}, poses);
  // Within the field of view, 29.5 by 23 degrees to either side, nothing is missed.
  const auto capture_at = [&](int x, int y, int z) {
    const auto found = first.find(packed(key_from_origin(x, y, z)));
    return found == first.end() ? -1 : static_cast<int>(found->second);
  };
  for (int y = -7; y <= 7; ++y) {
    for (int z = -5; z <= 5; ++z) {
      EXPECT_EQ(capture_at(15, y, z), 0) << y << ", " << z;
      EXPECT_EQ(capture_at(-15, y, z), 1) << y << ", " << z;
    }
  }
  EXPECT_EQ(capture_at(15, 10, 0), -1);  // out of sight
  for (const auto& [voxel, capture] : first) EXPECT_LT(capture, 2) << voxel;
}

}  // namespace
}  // namespace nbvopt::test
