// Every implementation of the caster against the reference.
#include "nbvopt/gain/ray_caster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "gain/reference_caster.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sensor/depth_camera.hpp"
#include "support/camera_pose.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// What single precision leaves in doubt, a hundred voxels from the camera.
constexpr double kGrazing_voxels = 1e-4;
constexpr double kOccupiedUncertainty = 0.875;

struct Rays {
  std::vector<double> x, y, z, range_min_m, range_max_m;

  void add(const Eigen::Vector3d& direction, double min_m, double max_m) {
    x.push_back(direction.x());
    y.push_back(direction.y());
    z.push_back(direction.z());
    range_min_m.push_back(min_m);
    range_max_m.push_back(max_m);
  }

  RayBundle bundle(const Transform& T_map_rays, bool near_blocking) const {
    return {T_map_rays, x, y, z, range_min_m, range_max_m, near_blocking};
  }
};

Eigen::Vector3d random_direction(std::mt19937_64& random) {
  for (;;) {
    const Eigen::Vector3d v(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
  }
}

/// Rays to all sides, each with its own range.
Rays random_rays(int n, std::mt19937_64& random) {
  Rays rays;
  for (int i = 0; i < n; ++i) {
    const double min_m = uniform(random, 0.2, 1.0);
    rays.add(random_direction(random), min_m, uniform(random, min_m, 8.0));
  }
  return rays;
}

Rays camera_rays(const DepthCamera& camera) {
  const CameraRays& r = camera.rays();
  return {r.x, r.y, r.z, r.range_min_m, r.range_max_m};
}

Transform random_pose(std::mt19937_64& random, double within_m) {
  Transform T_map_rays = Transform::Identity();
  T_map_rays.linear() =
      Eigen::AngleAxisd(uniform(random, -3.0, 3.0), random_direction(random)).toRotationMatrix();
  T_map_rays.translation() =
      within_m *
      Eigen::Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  return T_map_rays;
}

bool agrees(const ReferenceHit& expected, const RayHits& hits, std::size_t i) {
  return hits.kind[i] == expected.kind && hits.face[i] == expected.face &&
         hits.voxel[i] == expected.voxel && hits.uncertainty[i] == expected.uncertainty &&
         std::abs(hits.distance_m[i] - expected.distance_m) <= 1e-9 * expected.distance_m;
}

/// Counts the rays that end otherwise than the reference, and sees that each of them grazes.
struct Comparison {
  int rays = 0;
  int differing = 0;
  int blocked = 0;
  int occupied = 0;

  void add(const VoxelGrid& grid, const RayBundle& bundle) {
    std::vector<ReferenceHit> expected;
    for (std::size_t i = 0; i < bundle.size(); ++i) {
      expected.push_back(reference_cast(grid, bundle, i, kOccupiedUncertainty));
      blocked += expected.back().kind == HitKind::blocked;
      occupied += expected.back().kind == HitKind::occupied;
    }
    for (const SimdLevel level : supported_simd_levels()) {
      RayHits hits;
      cast_rays(grid, bundle, kOccupiedUncertainty, hits, level);
      ASSERT_EQ(hits.size(), bundle.size());
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const Eigen::Vector3d direction =
            bundle.T_map_rays.linear() * Eigen::Vector3d(bundle.x[i], bundle.y[i], bundle.z[i]);
        ASSERT_LT((Eigen::Vector3d(hits.direction_x[i], hits.direction_y[i], hits.direction_z[i]) -
                   direction)
                      .norm(),
                  1e-15);
        ++rays;
        if (agrees(expected[i], hits, i)) continue;
        ++differing;
        ASSERT_LT(expected[i].clearance_voxels, kGrazing_voxels)
            << to_string(level) << ", ray " << i << " of " << hits.size() << " along "
            << direction.transpose() << ": kind " << int(hits.kind[i]) << " at "
            << hits.distance_m[i] << " m, expected " << int(expected[i].kind) << " at "
            << expected[i].distance_m << " m";
      }
    }
  }
};

class CastRays : public ::testing::TestWithParam<double> {
 protected:
  /// 9 m of clutter at 0.1 m around the map's origin.
  CastRays() : map_(0.1), random_(11) {
    scatter(map_, cube(key_from_origin(-45, -45, -45), 90), GetParam(), random_);
    map_.finish_writing();
    grid_ = VoxelGrid::whole(map_);
  }

  UncertaintyMap map_;
  std::mt19937_64 random_;
  std::shared_ptr<const VoxelGrid> grid_;
};

TEST_P(CastRays, EndsWhereTheReferenceDoes) {
  // Fewer rays than a vector has lanes, as many, and numbers that no vector divides.
  constexpr int kSizes[] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 100, 257, 1000};
  for (const bool near_blocking : {true, false}) {
    Comparison comparison;
    for (int repeat = 0; repeat < 4; ++repeat) {
      for (const int n : kSizes) {
        const Rays rays = random_rays(n, random_);
        comparison.add(*grid_, rays.bundle(random_pose(random_, 4.6), near_blocking));
      }
    }
    EXPECT_LT(comparison.differing, 1e-4 * comparison.rays);
    EXPECT_EQ(comparison.blocked > 0, near_blocking && GetParam() > 0.0);
  }
}

TEST_P(CastRays, EndsWhereTheReferenceDoesForCameras) {
  SensorOptions sensor;
  sensor.range_min_m = 0.2;
  sensor.range_max_m = 8.0;
  const Rays rays = camera_rays(DepthCamera(sensor));
  for (const bool near_blocking : {true, false}) {
    Comparison comparison;
    for (int repeat = 0; repeat < 6; ++repeat) {
      comparison.add(*grid_, rays.bundle(random_pose(random_, 4.0), near_blocking));
    }
    EXPECT_LT(comparison.differing, 1e-4 * comparison.rays);
    EXPECT_EQ(comparison.occupied > 0, GetParam() > 0.0);
  }
}

TEST_P(CastRays, DoesNotDependOnHowTheGridWasBuilt) {
  const auto lazy = VoxelGrid::lazy(map_);
  const Rays rays = random_rays(333, random_);
  for (const SimdLevel level : supported_simd_levels()) {
    const Transform T_map_rays = random_pose(random_, 4.0);
    RayHits of_lazy, of_whole;
    cast_rays(*lazy, rays.bundle(T_map_rays, true), kOccupiedUncertainty, of_lazy, level);
    cast_rays(*grid_, rays.bundle(T_map_rays, true), kOccupiedUncertainty, of_whole, level);
    EXPECT_EQ(of_lazy.kind, of_whole.kind);
    EXPECT_EQ(of_lazy.face, of_whole.face);
    EXPECT_EQ(of_lazy.voxel, of_whole.voxel);
    EXPECT_EQ(of_lazy.distance_m, of_whole.distance_m);
    EXPECT_EQ(of_lazy.uncertainty, of_whole.uncertainty);
  }
}

INSTANTIATE_TEST_SUITE_P(Clutter, CastRays, ::testing::Values(0.3, 0.03, 0.003, 0.0003, 0.0));

/// From a corner of a voxel along the axes, nothing is rounded, so nothing is in doubt.
TEST(CastRaysAlongAxes, EndExactlyWhereTheReferenceDoes) {
  UncertaintyMap map(0.125);
  std::mt19937_64 random(5);
  scatter(map, cube(key_from_origin(-20, -20, -20), 40), 0.1, random);
  map.finish_writing();
  const auto grid = VoxelGrid::whole(map);

  Rays rays;
  for (const double sign : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double range_max_m : {0.5625, 1.0, 8.0}) {
        rays.add(sign * Eigen::Vector3d::Unit(axis), 0.5, range_max_m);
        rays.add(sign * Eigen::Vector3d::Unit(axis), 0.0, range_max_m);
      }
    }
  }
  for (int repeat = 0; repeat < 300; ++repeat) {
    Transform T_map_rays = Transform::Identity();
    // Whole voxels, with halves now and then.
    for (int a = 0; a < 3; ++a) {
      T_map_rays.translation()[a] = 0.0625 * uniform_int(random, -44, 44);
    }
    for (const bool near_blocking : {true, false}) {
      const RayBundle bundle = rays.bundle(T_map_rays, near_blocking);
      for (const SimdLevel level : supported_simd_levels()) {
        RayHits hits;
        cast_rays(*grid, bundle, 1.0, hits, level);
        for (std::size_t i = 0; i < bundle.size(); ++i) {
          const ReferenceHit expected = reference_cast(*grid, bundle, i, 1.0);
          ASSERT_TRUE(agrees(expected, hits, i))
              << to_string(level) << " from " << T_map_rays.translation().transpose() << ", ray "
              << i << ": kind " << int(hits.kind[i]) << " at " << hits.distance_m[i]
              << " m, expected " << int(expected.kind) << " at " << expected.distance_m << " m";
        }
      }
    }
  }
}

/// Off the lattice nothing is known.
TEST(CastRaysAtTheLatticesEnd, EndUnknown) {
  for (const int least : {0, 65536 - 24}) {
    UncertaintyMap map(0.1);
    set_box(map, cube(key_at(least, least, least), 24), kFree);
    map.finish_writing();
    const auto grid = VoxelGrid::lazy(map);
    Transform T_map_rays = Transform::Identity();
    T_map_rays.translation() = map.lattice().centre_m(key_at(least + 12, least + 12, least + 12));
    std::mt19937_64 random(3);
    Rays rays;
    for (int i = 0; i < 100; ++i) rays.add(random_direction(random), 0.2, 8.0);
    for (const bool near_blocking : {true, false}) {
      const RayBundle bundle = rays.bundle(T_map_rays, near_blocking);
      for (const SimdLevel level : supported_simd_levels()) {
        RayHits hits;
        cast_rays(*grid, bundle, 1.0, hits, level);
        for (std::size_t i = 0; i < hits.size(); ++i) {
          const Eigen::Vector3d direction(rays.x[i], rays.y[i], rays.z[i]);
          // The cube of free voxels ends 12 voxels below and 11 above the one in its middle.
          const Eigen::Array3d to_face_m =
              (direction.array() < 0.0).select(Eigen::Array3d::Constant(1.25), 1.15);
          ASSERT_EQ(hits.kind[i], HitKind::unknown) << to_string(level);
          ASSERT_NEAR(hits.distance_m[i], (to_face_m / direction.array().abs()).minCoeff(), 1e-6);
        }
      }
    }
  }
}

TEST(CastOneBundle, RefusesAnOriginThatIsNone) {
  const UncertaintyMap map(0.1);
  const auto grid = VoxelGrid::whole(map);
  std::mt19937_64 random(3);
  const Rays rays = random_rays(20, random);
  RayHits hits;
  Transform T_map_rays = Transform::Identity();
  for (const double bad_m : {3276.85, -3276.85, 1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    T_map_rays.translation() = Eigen::Vector3d(0.0, bad_m, 0.0);
    EXPECT_THROW(cast_rays(*grid, rays.bundle(T_map_rays, true), 1.0, hits), InputError) << bad_m;
  }
  T_map_rays = Transform::Identity();
  T_map_rays.linear()(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cast_rays(*grid, rays.bundle(T_map_rays, true), 1.0, hits), InputError);
}

/// The only occupied voxel anywhere, passed just before range_min, to each side of the camera.
TEST(CastOneBundle, IsBlockedByALoneVoxel) {
  for (const double sign : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      UncertaintyMap map(0.1);
      set_box(map, cube(key_from_origin(-12, -12, -12), 24), kFree);
      const Eigen::Vector3d ahead = sign * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d camera_m = Eigen::Vector3d::Constant(0.05);
      map.set(map.lattice().key(camera_m + 0.9 * ahead), occupied(1.0F));
      map.finish_writing();
      Rays rays;
      for (int i = 0; i < 16; ++i) rays.add(ahead, 0.96, 1.1);
      Transform T_map_rays = Transform::Identity();
      T_map_rays.translation() = camera_m;
      for (const SimdLevel level : supported_simd_levels()) {
        RayHits hits;
        cast_rays(*VoxelGrid::whole(map), rays.bundle(T_map_rays, true), 1.0, hits, level);
        EXPECT_EQ(hits.kind, std::vector<HitKind>(16, HitKind::blocked)) << ahead.transpose();
        EXPECT_EQ(hits.distance_m, rays.range_max_m);
      }
    }
  }
}

/// `occupied_uncertainty` speaks for maps that carry none, not for voxels that were never seen.
TEST(CastOneBundle, TakesTheGivenUncertaintyOnlyWhereTheMapCarriesNone) {
  UncertaintyMap map(0.1);
  set_box(map, cube(key_from_origin(-8, -8, -8), 16), kFree);
  map.set(key_from_origin(6, 0, 0), occupied(1.0F));
  map.finish_writing();
  Rays rays;
  for (int i = 0; i < 16; ++i) rays.add(Eigen::Vector3d::UnitX(), 0.2, 1.0);
  Transform T_map_rays = Transform::Identity();
  T_map_rays.translation() = Eigen::Vector3d::Constant(0.05);

  const auto uncertainty = [&](const VoxelGrid& grid, SimdLevel level) {
    RayHits hits;
    cast_rays(grid, rays.bundle(T_map_rays, true), 0.25, hits, level);
    EXPECT_EQ(hits.kind.front(), HitKind::occupied);
    EXPECT_EQ(hits.uncertainty.front(), hits.uncertainty.back());
    return hits.uncertainty.front();
  };
  for (const SimdLevel level : supported_simd_levels()) {
    EXPECT_EQ(uncertainty(*VoxelGrid::whole(map), level), 0.25F);
  }
  map.set(key_from_origin(-6, 0, 0), occupied(0.5F));
  map.finish_writing();
  for (const SimdLevel level : supported_simd_levels()) {
    EXPECT_EQ(uncertainty(*VoxelGrid::whole(map), level), 1.0F);
  }
}

TEST(SimdLevels, AreNamedBestFirst) {
  const std::vector<SimdLevel> levels = supported_simd_levels();
  ASSERT_FALSE(levels.empty());
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  EXPECT_EQ(levels.back(), SimdLevel::scalar);
  EXPECT_STREQ(to_string(SimdLevel::avx2), "avx2");
}

}  // namespace
}  // namespace nbvopt::test
