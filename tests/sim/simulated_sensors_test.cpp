// What the camera and the lidar see in scenes that are known by hand.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "nbvopt/core/error.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "nbvopt/sim/simulated_lidar.hpp"
#include "sim/box_mesh.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

/// A wall across the x axis whose near face stands at this x, as wide and high as asked for.
Scene wall_at(double x_m, double half_size_m = 50.0) {
  TriangleMesh mesh;
  add_box(mesh, {x_m, -half_size_m, -half_size_m}, {x_m + 0.1, half_size_m, half_size_m});
  return Scene(mesh);
}

/// The optical frame at the map's origin, looking along x.
Transform looking_along_x() {
  Transform T = Transform::Identity();
  T.linear() = rotation_body_sensor();
  return T;
}

TEST(SimulatedCamera, SeesAWallWhereItStands) {
  const Scene scene = wall_at(2.0);
  const SensorOptions sensor;
  const Scan scan = SimulatedCamera(scene, sensor, 0.0, 1).capture(looking_along_x(), 0);
  ASSERT_EQ(scan.points_m.size(), 480U * 360U);
  EXPECT_TRUE(scan.no_returns.empty());
  for (const Eigen::Vector3f& p_sensor_m : scan.points_m) ASSERT_NEAR(p_sensor_m.z(), 2.0F, 1e-5F);
  // The first pixel is the image's upper left corner: x to the right, y down.
  const double edge_x = std::tan(sensor.half_fov_horizontal_rad) * (1.0 / 480.0 - 1.0);
  const double edge_y = std::tan(sensor.half_fov_vertical_rad) * (1.0 / 360.0 - 1.0);
  EXPECT_NEAR(scan.points_m.front().x(), 2.0 * edge_x, 1e-5);
  EXPECT_NEAR(scan.points_m.front().y(), 2.0 * edge_y, 1e-5);
}

TEST(SimulatedCamera, TellsFarFromNear) {
  const SensorOptions sensor;
  const auto capture = [&](double x_m) {
    const Scene scene = wall_at(x_m);
    return SimulatedCamera(scene, sensor, 0.0, 1).capture(looking_along_x(), 0);
  };
  const Scan near = capture(0.45);  // the corners of the image are farther than range_min_m
  EXPECT_GT(near.points_m.size(), 0U);
  EXPECT_LT(near.points_m.size(), 480U * 360U / 2U);
  EXPECT_TRUE(near.no_returns.empty());
  for (const auto& p : near.points_m) ASSERT_GE(p.norm(), sensor.range_min_m - 1e-6);

  const Scan far = capture(3.9);
  EXPECT_EQ(far.points_m.size() + far.no_returns.size(), 480U * 360U);
  for (const auto& p : far.points_m) ASSERT_LT(p.norm(), sensor.range_max_m + 1e-6);
  for (const auto& d : far.no_returns) ASSERT_GE(3.9 / d.z(), sensor.range_max_m - 1e-5);

  const Scan beyond = capture(4.1);
  EXPECT_TRUE(beyond.points_m.empty());
  EXPECT_EQ(beyond.no_returns.size(), 480U * 360U);
}

TEST(SimulatedCamera, AddsTheNoiseThatWasAskedFor) {
  constexpr double kNoise_m = 0.02;
  const Scene scene = wall_at(2.0);
  const SimulatedCamera camera(scene, SensorOptions{}, kNoise_m, 5);
  const Scan scan = camera.capture(looking_along_x(), 3);
  double sum = 0.0;
  double squares = 0.0;
  for (const Eigen::Vector3f& p : scan.points_m) {
    const double error_m = p.norm() - 2.0 * p.norm() / p.z();
    sum += error_m;
    squares += error_m * error_m;
  }
  const auto n = static_cast<double>(scan.points_m.size());
  EXPECT_NEAR(sum / n, 0.0, 3.0 * kNoise_m / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), kNoise_m, 0.01 * kNoise_m);
}

TEST(SimulatedCamera, DrawsNoiseByFrameAndSeed) {
  const Scene scene = wall_at(2.0);
  const auto points = [&](std::uint64_t seed, std::uint64_t frame) {
    return SimulatedCamera(scene, SensorOptions{}, 0.02, seed)
        .capture(looking_along_x(), frame)
        .points_m;
  };
  EXPECT_EQ(points(5, 3), points(5, 3));
  EXPECT_NE(points(5, 3), points(5, 4));
  EXPECT_NE(points(5, 3), points(6, 3));
}

TEST(SimulatedCamera, MeasuresAlongThePlanningRays) {
  const Scene scene = wall_at(0.3);
  const SensorOptions sensor;
  const std::vector<float> distances =
      SimulatedCamera(scene, sensor, 0.0, 1).planning_distances_m(looking_along_x());
  const DepthCamera planning_camera(sensor);
  const CameraRays& rays = planning_camera.rays();
  ASSERT_EQ(distances.size(), rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_NEAR(distances[i], 0.3 / rays.z[i], 1e-5);
}

TEST(SimulatedCamera, RefusesBadNoise) {
  const Scene scene = wall_at(2.0);
  EXPECT_EQ(message_of<InputError>([&] { SimulatedCamera(scene, {}, -0.1, 1); }),
            "the range noise is -0.1 m, it must be 0 or more and finite");
}

TEST(SimulatedLidar, SeesThePlaneAtItsHeight) {
  TriangleMesh mesh;
  add_box(mesh, {-3.0, -2.0, -1.0}, {4.0, 5.0, 1.0});
  add_box(mesh, {1.0, -0.1, -1.0}, {1.1, 0.1, 0.1});  // below the beams
  const Scene scene(mesh);
  const SimulatedLidar lidar(scene, {});
  const std::vector<float> ranges = lidar.scan(Transform::Identity());
  ASSERT_EQ(ranges.size(), 720U);
  EXPECT_FLOAT_EQ(ranges[0], 4.0F);
  EXPECT_FLOAT_EQ(ranges[180], 5.0F);
  EXPECT_FLOAT_EQ(ranges[360], 3.0F);
  EXPECT_FLOAT_EQ(ranges[540], 2.0F);
  EXPECT_NEAR(lidar.angle_rad(180), std::numbers::pi / 2.0, 1e-12);
}

TEST(SimulatedLidar, TurnsWithTheBase) {
  TriangleMesh mesh;
  add_box(mesh, {-3.0, -2.0, -1.0}, {4.0, 5.0, 1.0});
  const Scene scene(mesh);
  const std::vector<float> ranges =
      SimulatedLidar(scene, {}).scan(base_pose(1.0, 0.0, 0.0, std::numbers::pi / 2.0));
  EXPECT_FLOAT_EQ(ranges[0], 5.0F);
  EXPECT_FLOAT_EQ(ranges[180], 4.0F);
  EXPECT_FLOAT_EQ(ranges[540], 3.0F);
}

TEST(SimulatedLidar, GivesInfinitiesAsDriversDo) {
  TriangleMesh mesh;
  add_box(mesh, {1.0, -0.1, -1.0}, {1.1, 0.1, 1.0});
  add_box(mesh, {-0.2, -0.1, -1.0}, {-0.1, 0.1, 1.0});
  const Scene scene(mesh);
  const std::vector<float> ranges = SimulatedLidar(scene, {}).scan(Transform::Identity());
  EXPECT_FLOAT_EQ(ranges[0], 1.0F);
  EXPECT_EQ(ranges[180], kInfinity);
  EXPECT_EQ(ranges[360], -kInfinity);
}

TEST(SimulatedLidar, RefusesBadOptions) {
  const Scene scene = wall_at(2.0);
  EXPECT_EQ(message_of<InputError>([&] { SimulatedLidar(scene, {.beams = 0}); }),
            "lidar.beams is 0, it must be 1 or more");
  EXPECT_EQ(message_of<InputError>([&] { SimulatedLidar(scene, {.range_max_m = kInfinity}); }),
            "lidar.range_max_m is inf, it must be greater than range_min_m and finite");
}

}  // namespace
}  // namespace nbvopt::test
