// The contract of every gain that has a name, and of sums of them, on maps made by chance.
#include <gtest/gtest.h>

#include <cmath>

#include "nbvopt/gain/view_evaluator.hpp"
#include "sensor/sensor_names.hpp"
#include "support/camera_pose.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// Whether the entropy of free voxels is worth something.
bool counts_free_voxels(const GainChoice& gain) { return gain.has(GainKind::occlusion_aware); }

class GainContract : public ::testing::TestWithParam<std::string> {
 protected:
  static GainChoice gain() {
    GainChoice choice;
    EXPECT_EQ(store(FieldValue(GetParam()), choice), "");
    return choice;
  }

  static std::unique_ptr<ViewEvaluator> evaluator(std::shared_ptr<const VoxelGrid> grid) {
    SensorOptions sensor;
    sensor.horizontal_rays = 13;
    sensor.vertical_rays = 9;
    sensor.range_min_m = 0.6;
    sensor.range_max_m = 2.0;
    sensor.gain = gain();
    return make_exact_evaluator(std::move(grid), DepthCamera(sensor), HazardTable(-1.0));
  }
};

using Voxels = std::vector<std::pair<Eigen::Vector3i, VoxelRecord>>;

/// Clutter around the map's origin, some of it unknown; keys count from there.
Voxels clutter(int seed) {
  std::mt19937_64 random(seed);
  Voxels voxels;
  for (int z = -22; z < 22; ++z) {
    for (int y = -22; y < 22; ++y) {
      for (int x = -22; x < 22; ++x) {
        const bool is_near = std::abs(x) < 4 && std::abs(y) < 4 && std::abs(z) < 4;
        const double draw = uniform(random);
        if (!is_near && draw < 0.3) continue;
        voxels.emplace_back(
            Eigen::Vector3i(x, y, z),
            !is_near && draw < 0.33 ? occupied(static_cast<float>(uniform(random))) : kFree);
      }
    }
  }
  return voxels;
}

UncertaintyMap map_of(const Voxels& voxels) {
  UncertaintyMap map(0.1);
  for (const auto& [key, record] : voxels) {
    map.set(key_from_origin(key.x(), key.y(), key.z()), record);
  }
  map.finish_writing();
  return map;
}

std::vector<Transform> some_views() {
  std::vector<Transform> views;
  for (int i = 0; i < 12; ++i) {
    views.push_back(camera_at({0.031 + 0.01 * i, -0.042, 0.013}, 0.53 * i, 0.07 * i - 0.4));
  }
  return views;
}

TEST_P(GainContract, IsFiniteAndNeverNegativeAndEveryRayEndsSomehow) {
  const auto view_gain = evaluator(VoxelGrid::whole(map_of(clutter(1))));
  double most = 0.0;
  for (const Transform& pose : some_views()) {
    const ViewGain view = view_gain->evaluate(pose);
    EXPECT_TRUE(std::isfinite(view.gain));
    EXPECT_GE(view.gain, 0.0);
    EXPECT_EQ(view.unknown_rays + view.occupied_rays + view.free_rays, 13 * 9);
    most = std::max(most, view.gain);
  }
  EXPECT_GT(most, 0.0);
}

TEST_P(GainContract, IsTheSameOnAnyNumberOfThreadsAndHoweverTheGridIsRead) {
  const UncertaintyMap map = map_of(clutter(2));
  const std::vector<Transform> views = some_views();
  const auto one = evaluate_views(*evaluator(VoxelGrid::whole(map)), views, 1);
  EXPECT_EQ(evaluate_views(*evaluator(VoxelGrid::whole(map)), views, 4), one);
  EXPECT_EQ(evaluate_views(*evaluator(VoxelGrid::lazy(map)), views, 4), one);
}

TEST_P(GainContract, StaysWhenMapAndCameraTurnTogetherByQuarters) {
  Voxels voxels = clutter(3);
  std::vector<Transform> views = some_views();
  const auto before = evaluate_views(*evaluator(VoxelGrid::whole(map_of(voxels))), views, 1);
  for (int quarter = 1; quarter < 4; ++quarter) {
    for (auto& [key, record] : voxels) key = Eigen::Vector3i(-1 - key.y(), key.x(), key.z());
    const Transform turn(Eigen::AngleAxisd(0.5 * EIGEN_PI, Eigen::Vector3d::UnitZ()));
    for (Transform& pose : views) pose = turn * pose;
    const auto after = evaluate_views(*evaluator(VoxelGrid::whole(map_of(voxels))), views, 1);
    for (std::size_t i = 0; i < views.size(); ++i) {
      EXPECT_NEAR(after[i].gain, before[i].gain, 1e-5 * (1.0 + before[i].gain)) << i;
      EXPECT_EQ(after[i].unknown_rays, before[i].unknown_rays) << i;
    }
  }
}

TEST_P(GainContract, IsNothingBehindASurfaceNearerThanTheRange) {
  Voxels voxels = clutter(4);
  for (auto& [key, record] : voxels) {
    if (key.cwiseAbs().maxCoeff() == 2) record = occupied(0.9F);
  }
  const auto view_gain = evaluator(VoxelGrid::whole(map_of(voxels)));
  for (const Transform& pose : some_views()) {
    const ViewGain view = view_gain->evaluate(pose);
    EXPECT_EQ(view.gain, 0.0);
    EXPECT_EQ(view.free_rays, 13 * 9);
  }
}

TEST_P(GainContract, IsNothingWhereAllInRangeIsFreeUnlessItCountsFreeVoxels) {
  UncertaintyMap map(0.1);
  set_box(map, cube(key_from_origin(-24, -24, -24), 48), kFree);
  map.finish_writing();
  const auto view_gain = evaluator(VoxelGrid::whole(map));
  for (const Transform& pose : some_views()) {
    EXPECT_EQ(view_gain->evaluate(pose).gain > 0.0, counts_free_voxels(gain()));
  }
}

TEST_P(GainContract, IsReadBackFromItsName) {
  GainChoice same;
  EXPECT_EQ(store(FieldValue(to_string(gain())), same), "");
  EXPECT_EQ(same, gain());
}

std::vector<std::string> gains_and_a_sum() {
  std::vector<std::string> gains = gain_names();
  gains.emplace_back("positive + 0.5*expected + 0.25*proximity_count");
  return gains;
}

INSTANTIATE_TEST_SUITE_P(EveryGain, GainContract, ::testing::ValuesIn(gains_and_a_sum()));

}  // namespace
}  // namespace nbvopt::test
