// What normals take off the gain: by hand on walls, and in all that counts gains alike.
#include "gain/normal_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "support/camera_pose.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

constexpr double kWeight = 0.4;
constexpr double kWall_m = 2.0;
const Eigen::Vector3d kEye_m(0.03, 0.02, 0.01);

SensorOptions one_ray(double weight) {
  SensorOptions sensor;
  sensor.horizontal_rays = 1;
  sensor.vertical_rays = 1;
  sensor.normal_weight = weight;
  return sensor;
}

/// Free space before a wall across x, which is known with u = 0.875, or not known at all.
std::shared_ptr<const VoxelGrid> wall(bool is_known) {
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-0.5, -3.0, -1.0}, {kWall_m, 3.0, 1.0}), kFree);
  if (is_known) {
    set_box(map, keys_between(map.lattice(), {kWall_m, -3.0, -1.0}, {kWall_m + 0.1, 3.0, 1.0}),
            occupied(0.875F));
  }
  map.finish_writing();
  return VoxelGrid::whole(map);
}

/// Equation 2 of what a ray meets on the wall, by half, as in Equation 8.
double u_at_wall(double yaw_rad) {
  const double distance_m = (kWall_m - kEye_m.x()) / std::cos(yaw_rad);
  return 0.5 * (1.0 - 2.0 / (1.0 + std::exp(std::abs(distance_m - 1.0))));
}

double gain(const std::shared_ptr<const VoxelGrid>& grid, const SensorOptions& sensor,
            double yaw_rad) {
  return make_exact_evaluator(grid, DepthCamera(sensor))->evaluate(camera_at(kEye_m, yaw_rad)).gain;
}

TEST(NormalPart, OfAWallIsTheSlantOfTheRay) {
  for (const double yaw_rad : {0.0, 0.4, -0.7}) {
    const double u_normal = 1.0 - std::cos(yaw_rad);
    EXPECT_NEAR(gain(wall(true), one_ray(kWeight), yaw_rad),
                double{0.875F} - (1.0 - kWeight) * u_at_wall(yaw_rad) - kWeight * u_normal, 1e-6)
        << yaw_rad;
  }
}

TEST(NormalPart, OfTheUnknownIsTheMean) {
  EXPECT_NEAR(gain(wall(false), one_ray(kWeight), 0.4),
              1.0 - (1.0 - kWeight) * u_at_wall(0.4) - kWeight * 0.4, 1e-6);
}

TEST(NormalPart, FollowsASlantingWall) {
  UncertaintyMap map(0.1);
  for_each_key(cube(key_from_origin(-10, -10, -10), 20), [&](VoxelKey key) {
    const int x = key.x - Lattice::kKeyOfOrigin, y = key.y - Lattice::kKeyOfOrigin;
    if (x + y < 0) map.set(key, kFree);
    if (x + y == 0 || x + y == 1) map.set(key, occupied(0.5F));
  });
  map.finish_writing();
  const auto grid = VoxelGrid::whole(map);
  const Eigen::Vector3d normal = detail::surface_normal(*grid, key_from_origin(0, 0, 0));
  EXPECT_NEAR(normal.dot(Eigen::Vector3d(-1.0, -1.0, 0.0).normalized()), 1.0, 1e-12);
  EXPECT_TRUE(detail::surface_normal(*grid, key_from_origin(5, 5, 0)).isZero())
      << "nothing around it is free";
}

TEST(NormalPart, IsTheSameInAnExpectedGainWhoseHazardsAreInfinite) {
  std::mt19937_64 random(3);
  UncertaintyMap map(0.1);
  scatter(map, cube(key_from_origin(-20, -20, -20), 40), 0.05, random);
  set_box(map, cube(key_from_origin(-6, -6, -6), 13), kFree);
  map.finish_writing();
  const auto grid = VoxelGrid::whole(map);
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    SensorOptions sensor;
    sensor.counting = counting;
    sensor.normal_weight = kWeight;
    const auto positive = make_exact_evaluator(grid, DepthCamera(sensor));
    const auto expected = make_expected_evaluator(
        grid, DepthCamera(sensor), HazardTable::uniform(std::numeric_limits<double>::infinity()));
    for (int i = 0; i < 4; ++i) {
      const Transform pose = camera_at(kEye_m, 0.7 * i, 0.1 * i - 0.2);
      const double a = positive->evaluate(pose).gain;
      EXPECT_NEAR(expected->evaluate(pose).gain, a, 2e-6 * a) << to_string(counting);
    }
  }
}

TEST(NormalPart, IsNotThePapersCodes) {
  UncertaintyMap map(0.1);
  map.set(key_from_origin(0, 0, 0), kFree);
  map.finish_writing();
  EXPECT_THROW(make_evaluator("paper-code", map, VoxelGrid::whole(map), one_ray(kWeight)),
               UsageError);
}

}  // namespace
}  // namespace nbvopt::test
