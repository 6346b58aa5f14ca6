// Normals of scans: of planes, at edges, and what an insertion makes of them.
#include "map/scan_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "nbvopt/map/scan.hpp"
#include "nbvopt/sensor/depth_camera.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"
#include "support/camera_pose.hpp"

namespace nbvopt::test {
namespace {

constexpr int kWidth = 96, kHeight = 72;

/// What a depth image sees of the plane n . p = d, in the sensor frame.
std::vector<Eigen::Vector3f> plane(const SensorOptions& sensor, const Eigen::Vector3d& normal,
                                   double d_m) {
  const CameraRays rays = make_rays(sensor, kWidth, kHeight);
  std::vector<Eigen::Vector3f> points_m;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d direction = rays.direction(i);
    points_m.push_back((d_m / normal.dot(direction) * direction).cast<float>());
  }
  return points_m;
}

TEST(ScanNormals, OfAPlaneAreItsNormal) {
  for (const RayPattern pattern : {RayPattern::pixel_centres, RayPattern::equal_angles}) {
    SensorOptions sensor;
    sensor.ray_pattern = pattern;
    const Eigen::Vector3d away = Eigen::Vector3d(0.5, -0.3, 1.0).normalized();
    const auto normals = scan_normals(plane(sensor, away, 1.5), sensor, kWidth, kHeight);
    ASSERT_EQ(normals.size(), static_cast<std::size_t>(kWidth * kHeight));
    for (const Eigen::Vector3f& normal : normals) {
      EXPECT_NEAR(normal.cast<double>().dot(-away), 1.0, 1e-4) << "towards the camera";
    }
  }
}

TEST(ScanNormals, AreNotTakenOverAnEdge) {
  const SensorOptions sensor;
  auto points_m = plane(sensor, Eigen::Vector3d::UnitZ(), 1.0);
  for (int row = 0; row < kHeight; ++row) {
    for (int column = kWidth / 2; column < kWidth; ++column) {
      points_m[static_cast<std::size_t>(row * kWidth + column)] *= 2.0F;
    }
  }
  for (const Eigen::Vector3f& normal : scan_normals(points_m, sensor, kWidth, kHeight)) {
    EXPECT_NEAR(normal.z(), -1.0F, 1e-3F);
  }
}

TEST(ScanNormals, AreNotKnownOfWhatIsAlone) {
  const std::vector<Eigen::Vector3f> points_m{
      {0.0F, 0.0F, 1.0F}, {0.3F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}, {NAN, 0.0F, 1.0F}};
  for (const Eigen::Vector3f& normal : scan_normals(points_m, {}, kWidth, kHeight)) {
    EXPECT_TRUE(normal.isZero());
  }
}

TEST(ScanNormals, OfAVoxelAreThoseOfTheFaceThatTheRayEnters) {
  const VoxelKey voxel{10, 20, 30};
  const Eigen::Vector3d middle(10.5, 20.5, 30.5);
  EXPECT_EQ(entered_face_normal({0.5, 20.5, 30.5}, middle, voxel), -Eigen::Vector3d::UnitX());
  EXPECT_EQ(entered_face_normal({11.5, 25.5, 30.5}, middle, voxel), Eigen::Vector3d::UnitY());
  EXPECT_EQ(entered_face_normal({10.6, 20.6, 90.0}, middle, voxel), Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(entered_face_normal({10.2, 20.2, 30.2}, middle, voxel).isZero());
}

TEST(ScanNormals, CountInWhatIsInserted) {
  SensorOptions sensor;
  sensor.normal_weight = 0.4;
  sensor.horizontal_pixels = kWidth;
  sensor.vertical_pixels = kHeight;
  const Eigen::Vector3d away = Eigen::Vector3d(0.6, 0.0, 0.8);
  Scan scan;
  scan.points_m = plane(sensor, away, 1.2);
  UncertaintyMap map(0.1);
  const Transform T_map_sensor = camera_at({0.05, 0.05, 0.05});
  insert_scan(map, scan, T_map_sensor, sensor);
  // The best of the points in a voxel stays.
  const UncertaintyModel model(sensor);
  std::unordered_map<std::uint64_t, std::pair<VoxelKey, double>> least;
  for (const Eigen::Vector3f& point_m : scan.points_m) {
    const Eigen::Vector3d p_sensor_m = point_m.cast<double>();
    const double u_normal = 1.0 - std::abs(away.dot(p_sensor_m.normalized()));
    const double u = model.uncertainty(p_sensor_m) + 0.4 * u_normal;
    const VoxelKey key = map.lattice().key(T_map_sensor * p_sensor_m);
    const auto [known, is_new] = least.try_emplace(packed(key), key, u);
    if (!is_new) known->second.second = std::min(known->second.second, u);
  }
  for (const auto& [number, voxel] : least) {
    EXPECT_NEAR(map.at(voxel.first).uncertainty, voxel.second, 1e-4);
  }

  Scan alone;
  alone.points_m = {{0.0F, 0.0F, 1.0F}};
  UncertaintyMap other(0.1);
  insert_scan(other, alone, T_map_sensor, sensor);
  EXPECT_NEAR(other.at(other.lattice().key(T_map_sensor * Eigen::Vector3d(0, 0, 1))).uncertainty,
              0.0, 1e-6)
      << "the face that the ray enters is across it";
}

}  // namespace
}  // namespace nbvopt::test
