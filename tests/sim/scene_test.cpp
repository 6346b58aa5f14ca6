// Rays against triangles whose distances are known by hand.
#include "nbvopt/sim/scene.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "core/uniform.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/box_mesh.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

float distance_m(const Scene& scene, const Eigen::Vector3d& origin,
                 const Eigen::Vector3f& direction, float range_max_m = 100.0F) {
  float distance = 0.0F;
  scene.first_hits(origin, {&direction, 1}, range_max_m, {&distance, 1});
  return distance;
}

TEST(Scene, MeetsTheNearestSurfaceFromEitherSide) {
  TriangleMesh mesh;
  add_box(mesh, {1.0, -1.0, -1.0}, {2.0, 1.0, 1.0});
  const Scene scene(mesh);
  EXPECT_FLOAT_EQ(distance_m(scene, {0.0, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}), 1.0F);
  EXPECT_FLOAT_EQ(distance_m(scene, {4.0, 0.0, 0.0}, {-1.0F, 0.0F, 0.0F}), 2.0F);
  EXPECT_FLOAT_EQ(distance_m(scene, {1.5, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}), 0.5F);
  EXPECT_EQ(distance_m(scene, {0.0, 0.0, 0.0}, {-1.0F, 0.0F, 0.0F}), kInfinity);
}

TEST(Scene, SeesNothingBeyondItsRange) {
  TriangleMesh mesh;
  add_box(mesh, {1.0, -1.0, -1.0}, {2.0, 1.0, 1.0});
  const Scene scene(mesh);
  EXPECT_EQ(distance_m(scene, {0.0, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}, 0.99F), kInfinity);
  EXPECT_FLOAT_EQ(distance_m(scene, {0.0, 0.0, 0.0}, {1.0F, 0.0F, 0.0F}, 1.01F), 1.0F);
}

/// Every ray from inside a closed box meets it, edges and corners included.
TEST(Scene, LeaksNoRayFromAClosedBox) {
  const Eigen::Vector3d half(2.0, 3.0, 1.0);
  TriangleMesh mesh;
  add_box(mesh, -half, half);
  const Scene scene(mesh);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> component(-1.0, 1.0);
  std::vector<Eigen::Vector3f> directions;
  for (const double x : {-2.0, 0.0, 2.0}) {
    for (const double y : {-3.0, 0.0, 3.0}) {
      for (const double z : {-1.0, 1.0}) {
        directions.push_back(Eigen::Vector3d(x, y, z).normalized().cast<float>());
      }
    }
  }
  for (int i = 0; i < 100'000; ++i) {
    directions.push_back(Eigen::Vector3d(component(random), component(random), component(random))
                             .normalized()
                             .cast<float>());
  }
  std::vector<float> distances(directions.size());
  scene.first_hits(Eigen::Vector3d::Zero(), directions, 100.0F, distances);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double expected = (half.array() / directions[i].cast<double>().array().abs()).minCoeff();
    ASSERT_NEAR(distances[i], expected, 1e-5) << i;
  }
}

/// Points around a box, over its faces, edges and corners, and inside of it.
TEST(Scene, KnowsWhatIsNearASurface) {
  const Eigen::Vector3d half(0.5, 0.3, 0.2);
  TriangleMesh mesh;
  add_box(mesh, -half, half);
  const Scene scene(mesh);
  std::mt19937_64 random(5);
  int near = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d point =
        Eigen::Vector3d::NullaryExpr([&] { return 2 * uniform(random) - 1; });
    const Eigen::Array3d beyond = point.array().abs() - half.array();
    const double distance_m =
        beyond.maxCoeff() < 0.0 ? -beyond.maxCoeff() : beyond.max(0.0).matrix().norm();
    if (std::abs(distance_m - 0.1) < 1e-5) continue;
    EXPECT_EQ(scene.has_surface_within(point, 0.1F), distance_m < 0.1) << point.transpose();
    near += distance_m < 0.1 ? 1 : 0;
  }
  EXPECT_GT(near, 100);
}

TEST(Scene, GivesTheSameDistancesForAnyNumberOfThreads) {
  TriangleMesh mesh;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d corner(coordinate(random), coordinate(random), coordinate(random));
    add_box(mesh, corner, corner + Eigen::Vector3d(0.1, 0.4, 0.2));
  }
  const Scene scene(mesh);
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < 20'000; ++i) {
    directions.push_back(Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random))
                             .normalized()
                             .cast<float>());
  }
  std::vector<float> alone(directions.size());
  std::vector<float> together(directions.size());
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    scene.first_hits({0.1, 0.2, 0.3}, directions, 8.0F, alone);
  }
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  scene.first_hits({0.1, 0.2, 0.3}, directions, 8.0F, together);
  EXPECT_EQ(alone, together);
}

TEST(Scene, RefusesMeshesThatAreNone) {
  const auto make = [](const TriangleMesh& mesh) { return [mesh] { Scene{mesh}; }; };
  EXPECT_EQ(message_of<InputError>(make({})), "the scene holds no triangle: there is no geometry");
  EXPECT_EQ(message_of<UsageError>(make({{Eigen::Vector3f::Zero()}, {{0, 0, 1}}})),
            "a triangle of the scene has a corner that is not among its vertices");
  EXPECT_EQ(message_of<UsageError>(make({{Eigen::Vector3f::Constant(kInfinity)}, {{0, 0, 0}}})),
            "a vertex of the scene is not finite");
}

}  // namespace
}  // namespace nbvopt::test
