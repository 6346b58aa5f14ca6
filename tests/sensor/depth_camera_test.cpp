#include "nbvopt/sensor/depth_camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// Half angles of 45 degrees and of the tangent 0.5.
SensorOptions square_sensor() {
  SensorOptions sensor;
  sensor.half_fov_horizontal_rad = std::atan(1.0);
  sensor.half_fov_vertical_rad = std::atan(0.5);
  return sensor;
}

TEST(MakeRays, GoThroughPixelCentres) {
  const CameraRays rays = make_rays(square_sensor(), 4, 2);
  ASSERT_EQ(rays.size(), 8U);
  constexpr std::array<double, 4> kTangents_x{-0.75, -0.25, 0.25, 0.75};
  constexpr std::array<double, 2> kTangents_y{-0.25, 0.25};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_NEAR(rays.x[i] / rays.z[i], kTangents_x[i % 4], 1e-15);
    EXPECT_NEAR(rays.y[i] / rays.z[i], kTangents_y[i / 4], 1e-15);
    EXPECT_NEAR(rays.direction(i).norm(), 1.0, 1e-15);
    EXPECT_EQ(rays.range_min_m[i], 0.5);
    EXPECT_EQ(rays.range_max_m[i], 4.0);
  }
}

TEST(MakeRays, AreEquallySpacedInAngleFromEdgeToEdge) {
  SensorOptions sensor;
  sensor.ray_pattern = RayPattern::equal_angles;
  sensor.half_fov_horizontal_rad = 0.6;
  sensor.half_fov_vertical_rad = 0.4;
  const CameraRays rays = make_rays(sensor, 4, 3);
  constexpr std::array<double, 4> kAngles_x_rad{-0.6, -0.2, 0.2, 0.6};
  constexpr std::array<double, 3> kAngles_y_rad{-0.4, 0.0, 0.4};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_NEAR(std::atan2(rays.x[i], rays.z[i]), kAngles_x_rad[i % 4], 1e-15);
    EXPECT_NEAR(std::atan2(rays.y[i], rays.z[i]), kAngles_y_rad[i / 4], 1e-15);
    EXPECT_NEAR(rays.direction(i).norm(), 1.0, 1e-15);
  }
}

TEST(MakeRays, LookAheadWhereThereIsOne) {
  for (const RayPattern pattern : {RayPattern::pixel_centres, RayPattern::equal_angles}) {
    SensorOptions sensor;
    sensor.ray_pattern = pattern;
    EXPECT_EQ(make_rays(sensor, 1, 1).direction(0), Eigen::Vector3d::UnitZ());
  }
}

TEST(MakeRays, ReachFartherInTheCornersWhereTheRangeIsADepth) {
  SensorOptions sensor = square_sensor();
  sensor.range_axis = RangeAxis::z_depth;
  sensor.ray_pattern = RayPattern::equal_angles;
  const CameraRays rays = make_rays(sensor, 3, 3);
  EXPECT_NEAR(rays.range_min_m[0], 0.5 * 1.5, 1e-15) << "1.5 is |(1, 0.5, 1)|";
  EXPECT_NEAR(rays.range_max_m[0], 4.0 * 1.5, 1e-14);
  EXPECT_EQ(rays.range_min_m[4], 0.5);
  EXPECT_EQ(rays.range_max_m[4], 4.0);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_NEAR(rays.range_max_m[i] * rays.z[i], 4.0, 1e-14);
  }
}

using Ray = std::array<double, 5>;

std::vector<Ray> sorted(const CameraRays& rays) {
  std::vector<Ray> all;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    all.push_back({rays.x[i], rays.y[i], rays.z[i], rays.range_min_m[i], rays.range_max_m[i]});
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(DepthCamera, HasEveryRayOfItsImageOnceInTiles) {
  for (const auto& [width, height] : {std::pair{48, 36}, {7, 5}, {4, 4}, {1, 9}, {3, 1}}) {
    SensorOptions sensor;
    sensor.range_axis = RangeAxis::z_depth;
    sensor.horizontal_rays = width;
    sensor.vertical_rays = height;
    const DepthCamera camera(sensor);
    EXPECT_EQ(sorted(camera.rays()), sorted(make_rays(sensor, width, height)))
        << width << " x " << height;
  }
}

TEST(DepthCamera, KeepsNeighboursTogether) {
  const CameraRays rays = DepthCamera(SensorOptions{}).rays();
  // Three pixels of 0.0233 and 0.0236 along x and y are the widest that a tile spans.
  for (std::size_t tile = 0; tile < rays.size(); tile += 16) {
    for (std::size_t i = tile; i < tile + 16; ++i) {
      EXPECT_LT((rays.direction(i) - rays.direction(tile)).norm(), 0.105);
    }
  }
}

TEST(DepthCamera, RefusesOptionsThatAreNotValid) {
  SensorOptions sensor;
  sensor.vertical_rays = 0;
  EXPECT_THROW(DepthCamera camera(sensor), InputError);
}

}  // namespace
}  // namespace nbvopt
