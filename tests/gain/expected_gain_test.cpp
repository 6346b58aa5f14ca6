// The expected gain: its limits, its closed forms, and what it learns from.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gain/panorama_world.hpp"
#include "gain/ray_passages.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/hazard_file.hpp"
#include "nbvopt/gain/hazard_table.hpp"
#include "nbvopt/gain/named_evaluator.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "support/camera_pose.hpp"
#include "support/error_message.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const Eigen::Vector3d kCamera_m(0.03, 0.02, 0.01);

SensorOptions one_ray() {
  SensorOptions sensor;
  sensor.horizontal_rays = 1;
  sensor.vertical_rays = 1;
  return sensor;
}

double u_ahead(double distance_m) {
  return 0.5 * (1.0 - 2.0 / (1.0 + std::exp(std::abs(distance_m - 1.0))));
}

/// Voxels of 0.1 m: free around the camera up to `free_to_m` ahead, then unknown up to a wall.
std::shared_ptr<const VoxelGrid> slab(double free_to_m, double wall_m) {
  UncertaintyMap map(0.1);
  if (free_to_m > 0.0) {
    set_box(map, keys_between(map.lattice(), {-0.5, -1.0, -1.0}, {free_to_m, 1.0, 1.0}), kFree);
  }
  set_box(map, keys_between(map.lattice(), {wall_m, -1.0, -1.0}, {wall_m + 0.2, 1.0, 1.0}),
          occupied(0.875F));
  map.finish_writing();
  return VoxelGrid::whole(map);
}

/// Clutter in which nothing within half a metre is unknown.
std::shared_ptr<const VoxelGrid> cluttered(double unknown_share, int seed) {
  std::mt19937_64 random(seed);
  UncertaintyMap map(0.1);
  for_each_key(cube(key_from_origin(-20, -20, -20), 40), [&](VoxelKey key) {
    const double draw = uniform(random);
    if (draw < unknown_share) return;
    map.set(key, draw < unknown_share + 0.02
                     ? occupied(static_cast<float>(uniform_int(random, 0, 64)) / 64.0F)
                     : kFree);
  });
  set_box(map, cube(key_from_origin(-6, -6, -6), 13), kFree);
  map.finish_writing();
  return VoxelGrid::whole(map);
}

double expected_gain(const std::shared_ptr<const VoxelGrid>& grid, const SensorOptions& sensor,
                     const HazardTable& hazards, const Transform& T_map_sensor,
                     SimdLevel level = SimdLevel::best) {
  return make_expected_evaluator(grid, DepthCamera(sensor), hazards, level)
      ->evaluate(T_map_sensor)
      .gain;
}

/// Hazards that differ from context to context.
HazardTable varied_hazards() {
  HazardTable hazards(-0.2);
  for (std::size_t c = 0; c < HazardTable::kContexts; ++c) {
    hazards.set(c, {.hits = 0.25 + 0.15 * static_cast<double>(c), .metres = 1.0});
  }
  return hazards;
}

class ExpectedGain : public ::testing::TestWithParam<SimdLevel> {};

TEST_P(ExpectedGain, IsThatOfEquation12WhereHazardsAreInfinite) {
  const auto grid = cluttered(0.03, 3);
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    SensorOptions sensor;
    sensor.counting = counting;
    const auto positive = make_exact_evaluator(grid, DepthCamera(sensor));
    const auto expected = make_expected_evaluator(grid, DepthCamera(sensor),
                                                  HazardTable::uniform(kInfinite), GetParam());
    for (int i = 0; i < 8; ++i) {
      const Transform pose = camera_at(kCamera_m, 0.7 * i, 0.1 * i - 0.4);
      const ViewGain a = positive->evaluate(pose);
      const ViewGain b = expected->evaluate(pose);
      EXPECT_NEAR(b.gain, a.gain, 2e-6 * a.gain) << to_string(counting) << ", view " << i;
      EXPECT_NEAR(b.occupied_gain, a.occupied_gain, 1e-6 * a.gain);
      EXPECT_EQ(b.unknown_rays, a.unknown_rays);
    }
  }
}

TEST_P(ExpectedGain, IsThatOfEquation12WhereAllIsKnown) {
  std::mt19937_64 random(5);
  UncertaintyMap map(0.1);
  for_each_key(cube(key_from_origin(-45, -45, -45), 90), [&](VoxelKey key) {
    map.set(key, uniform(random) < 0.01 ? occupied(0.9F) : kFree);
  });
  map.finish_writing();
  const auto grid = VoxelGrid::whole(map);
  const SensorOptions sensor;
  const auto positive = make_exact_evaluator(grid, DepthCamera(sensor));
  for (int i = 0; i < 4; ++i) {
    const Transform pose = camera_at(kCamera_m, 1.5 * i, 0.2);
    const double gain = positive->evaluate(pose).gain;
    EXPECT_NEAR(expected_gain(grid, sensor, varied_hazards(), pose, GetParam()), gain,
                1e-12 * gain);
  }
}

TEST_P(ExpectedGain, OfASlabOfUnknownBeforeAWallIsTheIntegral) {
  constexpr double kHazard_per_m = 2.0;
  const SensorOptions sensor = one_ray();
  const double origin_m = kCamera_m.x();
  // Beyond the kink of Eq. 1; the camera stands at 0.03 m.
  const double begin_m = 1.3 - origin_m, end_m = 1.9 - origin_m;
  double integral = 0.0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double s = begin_m + (end_m - begin_m) * (i + 0.5) / kSteps;
    integral += kHazard_per_m * std::exp(-kHazard_per_m * (s - begin_m)) * (1.0 - u_ahead(s)) *
                (end_m - begin_m) / kSteps;
  }
  const double behind =
      std::exp(-kHazard_per_m * (end_m - begin_m)) * (double{0.875F} - u_ahead(end_m));
  EXPECT_NEAR(expected_gain(slab(1.3, 1.9), sensor, HazardTable::uniform(kHazard_per_m),
                            camera_at(kCamera_m), GetParam()),
              integral + behind, 1e-4);
}

TEST_P(ExpectedGain, GetsNothingFromTheUnknownNearerThanTheRange) {
  constexpr double kHazard_per_m = 3.0;
  SensorOptions sensor = one_ray();
  sensor.range_min_m = 0.5;
  // Unknown from the camera on to the wall, which stands right behind the near end.
  const double gain = expected_gain(slab(0.0, 0.5), sensor, HazardTable::uniform(kHazard_per_m),
                                    camera_at({-0.04, 0.02, 0.01}), GetParam());
  const double wall_m = 0.54;
  const double between_m = wall_m - 0.5;
  const double before = std::exp(-kHazard_per_m * 0.5);
  const double hit = 1.0 - std::exp(-kHazard_per_m * between_m);
  const double expected =
      before * (hit * (1.0 - u_ahead(0.52)) + (1.0 - hit) * (double{0.875F} - u_ahead(wall_m)));
  EXPECT_NEAR(gain, expected, 1e-3 * expected);
}

TEST_P(ExpectedGain, IsTheSameWithEveryInstructionSet) {
  const auto grid = cluttered(0.3, 9);
  SensorOptions sensor;
  for (const bool near_blocking : {true, false}) {
    sensor.near_blocking = near_blocking;
    for (int i = 0; i < 6; ++i) {
      const Transform pose = camera_at(kCamera_m + Eigen::Vector3d(0.9, 0.2, -0.3), i, 0.1);
      const double scalar = expected_gain(grid, sensor, varied_hazards(), pose, SimdLevel::scalar);
      EXPECT_NEAR(expected_gain(grid, sensor, varied_hazards(), pose, GetParam()), scalar,
                  3e-5 * scalar);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, ExpectedGain, ::testing::ValuesIn(supported_simd_levels()),
                         [](const auto& test) { return std::string(to_string(test.param)); });

TEST(ExpectedGainPerVoxel, CountsAVoxelWithItsBestRay) {
  SensorOptions sensor = one_ray();
  sensor.counting = Counting::per_voxel;
  const auto grid = slab(1.0, 1.6);
  const HazardTable hazards = HazardTable::uniform(2.0);
  SensorOptions per_ray = one_ray();
  const double once = expected_gain(grid, per_ray, hazards, camera_at(kCamera_m));
  EXPECT_NEAR(expected_gain(grid, sensor, hazards, camera_at(kCamera_m)), once, 1e-6);
  // Five rays within a voxel's width bring no more than the best of each voxel.
  sensor.horizontal_rays = 5;
  sensor.half_fov_horizontal_rad = 1e-3;
  sensor.uncertainty_half_fov_horizontal_rad = 0.5;
  EXPECT_NEAR(expected_gain(grid, sensor, hazards, camera_at(kCamera_m)), once, 1e-3);
}

TEST(ExpectedGainOfThePaperCode, IsRefused) {
  const UncertaintyMap map(0.1);
  SensorOptions sensor;
  sensor.gain = GainKind::expected;
  EXPECT_THROW(make_evaluator("paper-code", map, VoxelGrid::lazy(map), sensor), UsageError);
}

/// Per voxel, two hits stand for all voxels that a ray passes, and the best hit of a voxel may
/// change from view to view: the surrogate is coarse there, and has kinks.
class ExpectedPanorama : public ::testing::Test {
 protected:
  static PanoramaWorld world(Counting counting) {
    PanoramaWorld world;
    world.grid = cluttered(0.2, 11);
    world.sensor.gain = GainKind::expected;
    world.sensor.counting = counting;
    world.sensor.range_max_m = 1.5;
    return world;
  }
  static Panorama panorama(const PanoramaWorld& world) {
    return {world.grid, world.sensor,  world.moving_mast(),
            world.box,  world.options, varied_hazards()};
  }
};

TEST_F(ExpectedPanorama, HasTheGradientOfItsGain) {
  PanoramaWorld world = this->world(Counting::per_ray);
  world.options.double_precision = true;
  const Panorama surrogate = panorama(world);
  std::mt19937_64 random(2);
  for (int i = 0; i < 20; ++i) {
    const JointPosition q = world.random_joints(random);
    Eigen::Vector3d gradient, differences;
    surrogate.gain(q, gradient);
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(j);
      differences[j] = (surrogate.gain(JointPosition::from(q.vector() + step)) -
                        surrogate.gain(JointPosition::from(q.vector() - step))) /
                       2e-5;
    }
    EXPECT_LT((gradient - differences).norm(), 1e-3 * (1.0 + differences.norm())) << i;
  }
}

TEST_F(ExpectedPanorama, FollowsTheExactGain) {
  for (const auto& [counting, least_correlation] :
       {std::pair(Counting::per_ray, 0.995), std::pair(Counting::per_voxel, 0.8)}) {
    const PanoramaWorld world = this->world(counting);
    const Panorama surrogate = panorama(world);
    const auto exact =
        make_expected_evaluator(world.grid, DepthCamera(world.sensor), varied_hazards());
    std::mt19937_64 random(4);
    constexpr int kViews = 60;
    Eigen::ArrayXd smooth(kViews), judged(kViews);
    for (int i = 0; i < kViews; ++i) {
      const JointPosition q = world.random_joints(random);
      smooth[i] = surrogate.gain(q);
      judged[i] = exact->evaluate(world.T_map_sensor(q)).gain;
    }
    const Eigen::ArrayXd a = smooth - smooth.mean(), b = judged - judged.mean();
    EXPECT_GT((a * b).sum() / std::sqrt(a.square().sum() * b.square().sum()), least_correlation)
        << to_string(counting);
    if (counting == Counting::per_ray) {
      EXPECT_LT(((smooth - judged) / judged).abs().mean(), 0.01);
    }
  }
}

TEST(HazardTable, BeginsWithWhatIsLikelyEverywhere) {
  const HazardTable hazards;
  const auto unknown = [&](double height_m, bool beside_surface) {
    return hazards.hazard_per_m(HazardTable::unknown_context(height_m, 1.0, beside_surface));
  };
  EXPECT_GT(unknown(0.0, false), unknown(1.0, false)) << "a floor comes sooner than a chair";
  EXPECT_GT(unknown(1.0, true), unknown(1.0, false)) << "surfaces go on";
  EXPECT_LT(hazards.hazard_per_m(HazardTable::frontier_context(false)), unknown(1.0, false));
}

TEST(HazardTable, LearnsHitsAndMetresByContext) {
  const auto grid = slab(1.0, 3.0);  // unknown from 1 to 3 m
  HazardTable hazards(-0.5);         // the ray runs 0.51 m above the floor
  Scan scan;
  scan.points_m.emplace_back(0.0F, 0.0F, 1.62F);  // 0.65 m into the unknown
  scan.no_returns.emplace_back(0.0F, 0.0F, 1.0F);
  learn_hazards(*grid, scan, camera_at(kCamera_m), SensorOptions{}, hazards);

  const HazardTable untaught(-0.5);
  const auto learnt = [&](std::size_t context) {
    return HazardCount{hazards.count(context).hits - untaught.count(context).hits,
                       hazards.count(context).metres - untaught.count(context).metres};
  };
  // Voxels of 0.1 m in whose middle the ray has come 0.05, 0.15, 0.25 m; then the deeper ones.
  const HazardCount entry = learnt(HazardTable::unknown_context(0.5, 0.0, false));
  EXPECT_EQ(entry.hits, 0.0);
  EXPECT_NEAR(entry.metres, 2 * 0.3, 1e-6);
  // The return ends at 1.65 m of the map; the other ray ends at the wall, beside which the last
  // voxel lies.
  const HazardCount deep = learnt(HazardTable::unknown_context(0.5, 1.0, false));
  EXPECT_EQ(deep.hits, 1.0);
  EXPECT_NEAR(deep.metres, 0.35 + 1.6, 1e-6);
  EXPECT_NEAR(learnt(HazardTable::unknown_context(0.5, 1.0, true)).metres, 0.1, 1e-6);
  // The last free voxel touches the unknown.
  EXPECT_NEAR(learnt(HazardTable::frontier_context(false)).metres, 2 * 0.1, 1e-6);
}

TEST(HazardTable, IsNotTaughtByReturnsNearerThanTheRange) {
  const auto grid = slab(0.0, 3.0);
  HazardTable hazards;
  Scan scan;
  scan.points_m.emplace_back(0.0F, 0.0F, 0.3F);
  scan.points_m.emplace_back(0.0F, 0.0F, std::numeric_limits<float>::quiet_NaN());
  learn_hazards(*grid, scan, camera_at(kCamera_m), SensorOptions{}, hazards);
  EXPECT_EQ(hazards, HazardTable());
}

TEST(HazardFile, KeepsAllThatWasLearnt) {
  const HazardTable hazards = varied_hazards();
  EXPECT_EQ(parse_hazards(hazards_json(hazards), "h.json"), hazards);
  EXPECT_EQ(hazard_context_names().size(), HazardTable::kContexts);
  const HazardTable partly =
      parse_hazards(R"({"contexts": {"unknown_middle_deep": {"hits": 3, "metres": 2}}})", "h.json");
  EXPECT_EQ(partly.hazard_per_m(HazardTable::unknown_context(1.0, 1.0, false)), 1.5);
  EXPECT_EQ(partly.count(0), HazardTable().count(0));
}

TEST(HazardFile, IsRefusedInOneLineThatNamesTheKey) {
  const std::pair<const char*, const char*> kFaults[] = {
      {"{\n\"contexts\": {]}", "h.json: line 2: not valid JSON"},
      {R"({"floor_map_m": 1e999})", "a number is too large"},
      {"[]", "must be an object"},
      {R"({"context": {}})", "did you mean 'contexts'"},
      {R"({"contexts": {"unknown_floor": {}}})", "unknown_floor"},
      {R"({"contexts": {"free_frontier": {"hits": 1}}})", "free_frontier.metres"},
      {R"({"contexts": {"free_frontier": {"hits": -1, "metres": 1}}})", "free_frontier.hits"},
      {R"({"contexts": {"free_frontier": {"hits": "1", "metres": 1}}})", "must be a number"},
      {R"({"floor_map_m": null})", "floor_map_m"},
  };
  for (const auto& [text, named] : kFaults) {
    const std::string message =
        message_of<InputError>([&, text = text] { parse_hazards(text, "h.json"); });
    EXPECT_NE(message.find(named), std::string::npos) << message;
    EXPECT_EQ(message.find("h.json"), 0U) << message;
  }
}

}  // namespace
}  // namespace nbvopt::test
