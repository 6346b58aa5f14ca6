// The published gains against scenes whose every voxel is listed by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "gain/surface_distances.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "sensor/sensor_names.hpp"
#include "support/camera_pose.hpp"
#include "support/error_message.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

constexpr double kFreeP = 0.12;
constexpr double kSeen = 1.0 - kFreeP;  // what a free voxel lets through

double h(double p) { return -p * std::log(p) - (1.0 - p) * std::log(1.0 - p); }
const double kFreeH = h(kFreeP);
const double kUnknownH = std::log(2.0);
const double kOccupiedH = h(0.97);

SensorOptions ray_of(const GainChoice& gain, int rays = 1) {
  SensorOptions sensor;
  sensor.horizontal_rays = rays;
  sensor.vertical_rays = 1;
  sensor.range_min_m = 0.2;
  sensor.range_max_m = 1.0;
  sensor.gain = gain;
  return sensor;
}

const Transform kView = camera_at({0.05, 0.05, 0.05});

double gain_of(const UncertaintyMap& map, const SensorOptions& sensor,
               const Transform& T_map_sensor = kView) {
  return make_exact_evaluator(VoxelGrid::whole(map), DepthCamera(sensor), HazardTable())
      ->evaluate(T_map_sensor)
      .gain;
}

/// Voxels 2 to 4 along the ray are free, 5 and 6 unknown, 7 occupied; the range begins in 2.
UncertaintyMap hidden_surface() {
  UncertaintyMap map(0.1);
  for (int x = 0; x <= 4; ++x) map.set(key_from_origin(x, 0, 0), kFree);
  map.set(key_from_origin(7, 0, 0), occupied(0.875F));
  map.finish_writing();
  return map;
}

TEST(VolumetricGains, OfARayThatEndsBehindUnknownVoxels) {
  const UncertaintyMap map = hidden_surface();
  const double reach = std::pow(kSeen, 3);  // of voxel 5
  EXPECT_NEAR(
      gain_of(map, ray_of(GainKind::occlusion_aware)),
      kFreeH * (1.0 + kSeen + kSeen * kSeen) + kUnknownH * reach * 1.5 + kOccupiedH * reach * 0.25,
      1e-12);
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::unobserved_voxel)), kUnknownH * reach * 1.5, 1e-12);
  EXPECT_EQ(gain_of(map, ray_of(GainKind::rear_side_voxel)), 1.0);
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::rear_side_entropy)),
              kUnknownH * reach * 1.5 + kOccupiedH * reach * 0.25, 1e-12);
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::average_entropy)),
              (3.0 * kFreeH + 2.0 * kUnknownH + kOccupiedH) / 6.0, 1e-12);
  // d_max = 2 x 0.3 / 0.1; the unknown voxels lie 2 and 1 before the surface.
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::proximity_count)), (6.0 - 2.0) + (6.0 - 1.0), 1e-12);
}

TEST(VolumetricGains, MultiplyPVisByPOccAsTheReleasedCodeDoes) {
  SensorOptions sensor = ray_of(GainKind::occlusion_aware);
  sensor.visibility = Visibility::released;
  const double p = kFreeP;
  EXPECT_NEAR(
      gain_of(hidden_surface(), sensor),
      kFreeH * (1.0 + p + p * p) + kUnknownH * p * p * p * 1.5 + kOccupiedH * p * p * p * 0.25,
      1e-12);
}

TEST(VolumetricGains, OfARayThatEndsAtAKnownSurface) {
  UncertaintyMap map(0.1);
  for (int x = 0; x <= 4; ++x) map.set(key_from_origin(x, 0, 0), kFree);
  map.set(key_from_origin(5, 0, 0), occupied(0.5F));
  map.finish_writing();
  const double reach = std::pow(kSeen, 3);
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::occlusion_aware)),
              kFreeH * (1.0 + kSeen + kSeen * kSeen) + kOccupiedH * reach, 1e-12);
  for (const GainKind none : {GainKind::unobserved_voxel, GainKind::rear_side_voxel,
                              GainKind::rear_side_entropy, GainKind::proximity_count}) {
    EXPECT_EQ(gain_of(map, ray_of(none)), 0.0) << enum_name(none);
  }
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::average_entropy)), (3.0 * kFreeH + kOccupiedH) / 4.0,
              1e-12);
}

TEST(VolumetricGains, OfARayThroughNothingButTheUnknown) {
  // In range lie voxels 2 to 10.
  UncertaintyMap map(0.1);
  map.set(key_from_origin(0, 9, 9), kFree);
  map.finish_writing();
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::occlusion_aware)),
              kUnknownH * 2.0 * (1.0 - std::pow(0.5, 9)), 1e-12);
  for (const GainKind none : {GainKind::rear_side_voxel, GainKind::rear_side_entropy,
                              GainKind::average_entropy, GainKind::proximity_count}) {
    EXPECT_EQ(gain_of(map, ray_of(none)), 0.0) << enum_name(none);
  }
}

TEST(VolumetricGains, AreaWantsAFifthOfTheRaysOnSurfacesAndMostOnOcclusionPlanes) {
  // Two rays: the left one ends at a wall, the right one meets the unknown before another.
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-0.2, -1.0, -0.2}, {0.5, 1.0, 0.3}), kFree);
  set_box(map, keys_between(map.lattice(), {0.5, 0.0, -0.2}, {0.6, 1.0, 0.3}), occupied(0.5F));
  set_box(map, keys_between(map.lattice(), {0.7, -1.0, -0.2}, {0.8, 0.0, 0.3}), occupied(0.5F));
  map.finish_writing();
  const SensorOptions sensor = ray_of(GainKind::vasquez_gomez_area, 2);
  const Transform pose = camera_at({0.05, 0.001, 0.05});
  EXPECT_NEAR(gain_of(map, sensor, pose), 2.0 * 0.68359375, 1e-12);
  // Without the wall on the right, what is unknown there is beside no surface, and all of a share
  // of 0.5 is lost.
  UncertaintyMap open(0.1);
  set_box(open, keys_between(map.lattice(), {-0.2, -1.0, -0.2}, {0.5, 1.0, 0.3}), kFree);
  set_box(open, keys_between(map.lattice(), {0.5, 0.5, -0.2}, {0.6, 1.0, 0.3}), occupied(0.5F));
  open.finish_writing();
  EXPECT_EQ(gain_of(open, sensor, pose), 0.0);
}

TEST(VolumetricGains, WeightsOfVoxelsCountEachOnce) {
  const UncertaintyMap map = hidden_surface();
  // Voxel 6 is a frontier, 1. Voxel 7 lies 0.7 m away and is known as from 1 + ln 15 m away.
  const auto weight = [](double z) {
    return std::pow(2.0 * std::atan2(0.1, 2.0 * z), 2) / (0.002454 * 0.002681) / (z * z);
  };
  const double w_new = weight(0.7);
  const double expected = 1.0 + w_new / (w_new + weight(1.0 + std::log(15.0)));
  EXPECT_NEAR(gain_of(map, ray_of(GainKind::voxel_weight)), expected, 1e-9);
  SensorOptions many = ray_of(GainKind::voxel_weight, 5);
  many.half_fov_horizontal_rad = 0.01;  // all through the same voxels
  EXPECT_NEAR(gain_of(map, many), expected, 1e-9);
}

TEST(VolumetricGains, OfASumAreWeighted) {
  const UncertaintyMap map = hidden_surface();
  GainChoice sum;
  ASSERT_EQ(store(FieldValue("2*rear_side_voxel + positive+1e-1 * proximity_count"), sum), "");
  const double positive = gain_of(map, ray_of(GainKind::positive));
  EXPECT_GT(positive, 0.0);
  EXPECT_NEAR(gain_of(map, ray_of(sum)), 2.0 + positive + 0.9, 1e-12);
  EXPECT_EQ(to_string(sum), "2*rear_side_voxel + positive + 0.1*proximity_count");
  const GainChoice large({{GainKind::positive, 1e20}, {GainKind::expected, 3.0}});
  GainChoice same;
  EXPECT_EQ(store(FieldValue(to_string(large)), same), "");
  EXPECT_EQ(same, large);
}

TEST(VolumetricGains, RefuseWhatIsNoSum) {
  GainChoice gain = GainKind::expected;
  for (const char* text : {"", "entropy", "positive +", "0*positive", "-1*positive", "nan*expected",
                           "2*", "positive*2", "positive expected"}) {
    EXPECT_NE(store(FieldValue(text), gain).find("vasquez_gomez_area"), std::string::npos) << text;
    EXPECT_EQ(gain, GainKind::expected);
  }
  EXPECT_THROW(GainChoice(std::vector<GainTerm>{}), UsageError);
  SensorOptions sensor = ray_of(GainKind::occlusion_aware);
  sensor.counting = Counting::per_voxel;
  EXPECT_THROW(sensor.validate(), InputError);
}

TEST(SurfaceDistances, AreThoseToTheNearestSurfaceInWhateverBrick) {
  std::mt19937_64 random(11);
  UncertaintyMap map(0.1);
  std::vector<VoxelKey> surfaces;
  for (int i = 0; i < 40; ++i) {  // around a corner of eight bricks
    surfaces.push_back(key_from_origin(uniform_int(random, -8, 8), uniform_int(random, -8, 8),
                                       uniform_int(random, -8, 8)));
    map.set(surfaces.back(), occupied(0.5F));
  }
  map.finish_writing();
  const detail::SurfaceDistances distances(VoxelGrid::lazy(map), 0.3);
  EXPECT_EQ(distances.reach(), 3);
  for_each_key(cube(key_from_origin(-10, -10, -10), 21), [&](VoxelKey key) {
    double nearest = 1e9;
    for (const VoxelKey s : surfaces) {
      nearest = std::min(nearest, std::hypot(key.x - s.x, key.y - s.y, key.z - s.z));
    }
    const double found = distances.voxels_to_surface(key);
    if (nearest > 3.0) {
      EXPECT_TRUE(std::isinf(found));
    } else {
      EXPECT_NEAR(found, nearest, 1e-12);
    }
  });
}

}  // namespace
}  // namespace nbvopt::test
