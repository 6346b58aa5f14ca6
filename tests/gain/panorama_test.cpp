// The panorama where its answer is known, and what its values may not depend on.
#include "nbvopt/gain/panorama.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "gain/panorama_world.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/error_message.hpp"
#include "support/numbers.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

std::vector<JointPosition> corners(const JointBox& box) {
  std::vector<JointPosition> all;
  for (const double pan : {box.min[0], box.max[0]}) {
    for (const double tilt : {box.min[1], box.max[1]}) {
      for (const double height : {box.min[2], box.max[2]}) all.push_back({pan, tilt, height});
    }
  }
  return all;
}

std::vector<JointPosition> random_places(const PanoramaWorld& world, int count) {
  std::mt19937_64 random(5);
  std::vector<JointPosition> places;
  for (int i = 0; i < count; ++i) places.push_back(world.random_joints(random));
  return places;
}

/// The whole of an empty map: every ray ends at range_min.
double gain_of_unknown_space(const SensorOptions& sensor) {
  return gain_by_quadrature(sensor, [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
    return direction * (sensor.range_axis == RangeAxis::z_depth ? sensor.range_min_m / direction.z()
                                                                : sensor.range_min_m);
  });
}

TEST(Panorama, OfUnknownSpaceIsTheIntegralOverTheImage) {
  SensorOptions sensor;
  for (const RayPattern pattern : {RayPattern::pixel_centres, RayPattern::equal_angles}) {
    for (const RangeAxis axis : {RangeAxis::euclidean, RangeAxis::z_depth}) {
      sensor.ray_pattern = pattern;
      sensor.range_axis = axis;
      PanoramaWorld world;
      world.grid = unknown_space(0.05);
      world.sensor = sensor;
      const double expected = gain_of_unknown_space(sensor);
      const Panorama coarse = world.panorama();
      world.options.ray_spacing = 0.25;
      const Panorama fine = world.panorama();
      for (const JointPosition& q : random_places(world, 5)) {
        EXPECT_NEAR(coarse.gain(q), expected, 3e-3 * expected) << q.vector().transpose();
        EXPECT_NEAR(fine.gain(q), expected, 1e-3 * expected) << q.vector().transpose();
      }
    }
  }
}

/// A wall across map x, seen through free space; the camera looks about along x.
class PanoramaOfWall : public ::testing::Test {
 protected:
  static constexpr double kWall_m = 1.2;

  PanoramaOfWall() {
    UncertaintyMap map(0.1);
    set_box(map, keys_between(map.lattice(), {-0.3, -2.5, -2.0}, {kWall_m, 2.5, 2.5}), kFree);
    set_box(map, keys_between(map.lattice(), {kWall_m, -2.5, -2.0}, {1.3, 2.5, 2.5}),
            occupied(1.0F));
    map.finish_writing();
    world_.grid = VoxelGrid::whole(map);
    world_.T_map_base = base_pose(0.03, 0.02, 0.01, 0.0);
    world_.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
    world_.box = {{-0.3, -0.2, 0.3}, {0.3, 0.2, 0.5}};
  }

  double gain_of_wall(const JointPosition& q) const {
    const Transform T_map_sensor = world_.T_map_sensor(q);
    return gain_by_quadrature(world_.sensor,
                              [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
                                return direction * (kWall_m - T_map_sensor.translation().x()) /
                                       (T_map_sensor.linear() * direction).x();
                              });
  }

  void expect_gain_of_wall(double tolerance) const {
    const Panorama panorama = world_.panorama();
    for (const JointPosition& q : random_places(world_, 10)) {
      const double expected = gain_of_wall(q);
      EXPECT_NEAR(panorama.gain(q), expected, tolerance * expected) << q.vector().transpose();
    }
  }

  PanoramaWorld world_;
};

TEST_F(PanoramaOfWall, IsTheIntegralOverTheImage) { expect_gain_of_wall(3e-3); }

TEST_F(PanoramaOfWall, IsTheIntegralAwayFromTheLayersToo) {
  world_.options.layer_spacing = 8.0;  // one at either end
  expect_gain_of_wall(6e-3);
}

TEST_F(PanoramaOfWall, IsTheIntegralWithLeverArm) {
  world_.mast.sensor_offset_m = {0.06, -0.05, 0.04};
  expect_gain_of_wall(4e-3);
}

TEST_F(PanoramaOfWall, IsTheIntegralOnMovingBase) {
  world_.base_twist = {.vx_m_s = -0.3, .vy_m_s = 0.2, .wz_rad_s = 0.2};
  expect_gain_of_wall(4e-3);
}

TEST_F(PanoramaOfWall, ScalesWithTheNumberOfRays) {
  world_.sensor.horizontal_rays *= 2;
  world_.sensor.vertical_rays *= 3;
  expect_gain_of_wall(1.5e-3);
}

TEST_F(PanoramaOfWall, CountsVoxelsAsTheExactGainDoes) {
  world_.sensor.counting = Counting::per_voxel;
  const Panorama panorama = world_.panorama();
  for (const JointPosition& q : random_places(world_, 20)) {
    const double expected = world_.exact_gain(q);
    EXPECT_NEAR(panorama.gain(q), expected, 0.08 * expected) << q.vector().transpose();
  }
}

TEST_F(PanoramaOfWall, IsNothingOnceItIsKnownWell) {
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-0.3, -2.5, -2.0}, {kWall_m, 2.5, 2.5}), kFree);
  set_box(map, keys_between(map.lattice(), {kWall_m, -2.5, -2.0}, {1.3, 2.5, 2.5}), occupied(0.0F));
  map.finish_writing();
  world_.grid = VoxelGrid::whole(map);
  const Panorama panorama = world_.panorama();
  for (const JointPosition& q : random_places(world_, 5)) {
    Eigen::Vector3d gradient;
    EXPECT_LT(panorama.gain(q, gradient), 0.1) << "but for what the rounding adds";
  }
}

TEST(Panorama, AgreesWithTheExactGainAtTheCornersOfItsBox) {
  PanoramaWorld world = cluttered_world();
  world.mast.tilt_min_rad = -kPi / 2;
  world.mast.tilt_max_rad = kPi / 2;
  const double expected_unknown = gain_of_unknown_space(world.sensor);
  for (const JointBox& box :
       {JointBox{{0.2, -0.3, 0.4}, {0.2, -0.3, 0.4}},             // all joints frozen
        JointBox{{-1.0, 0.1, 0.35}, {1.5, 0.1, 0.35}},            // tilt and height frozen
        JointBox{{0.7, -0.6, 0.35}, {0.7, 0.5, 0.35}},            // pan and height frozen
        JointBox{{0.7, 0.1, 0.2}, {0.7, 0.1, 0.6}},               // pan and tilt frozen
        JointBox{{-kPi, -0.79, 0.3}, {kPi, 0.79, 0.5}},           // a full turn
        JointBox{{2.0, -0.2, 0.3}, {2.0 + 2.0 * kPi, 0.2, 0.5}},  // a full turn from elsewhere
        JointBox{{40.0, -0.2, 0.3}, {41.0, 0.2, 0.5}},            // after some turns
        JointBox{{-0.5, 0.9, 0.3}, {0.5, 1.5, 0.5}},              // over the pole
        JointBox{{-kPi, -1.5, 0.3}, {kPi, 1.5, 0.5}},             // over both poles
        JointBox{{0.0, 1.3, 0.3}, {0.0, 1.3, 0.3}}}) {            // at the pole only
    SCOPED_TRACE(::testing::Message() << box.min.transpose() << " to " << box.max.transpose());
    world.box = box;
    world.joints = JointPosition::from(0.5 * (box.min + box.max));
    const Panorama panorama = world.panorama();
    PanoramaWorld unknown = world;
    unknown.grid = unknown_space(0.1);
    const Panorama panorama_of_unknown = unknown.panorama();
    for (const JointPosition& q : corners(box)) {
      const double expected = world.exact_gain(q);
      EXPECT_NEAR(panorama.gain(q), expected, 0.03 * expected) << q.vector().transpose();
      EXPECT_NEAR(panorama_of_unknown.gain(q), expected_unknown, 5e-3 * expected_unknown)
          << q.vector().transpose();
    }
  }
}

TEST(Panorama, OfAFullTurnClosesAtItsSeam) {
  PanoramaWorld world = cluttered_world();
  world.box = {{-kPi, -0.4, 0.3}, {kPi, 0.4, 0.5}};
  world.options.double_precision = true;
  const Panorama panorama = world.panorama();
  for (const double tilt_rad : {-0.4, 0.0, 0.35}) {
    Eigen::Vector3d before, after;
    const double gain = panorama.gain({kPi, tilt_rad, 0.37}, before);
    EXPECT_NEAR(panorama.gain({-kPi, tilt_rad, 0.37}, after), gain, 1e-9 * gain);
    EXPECT_LT((before - after).norm(), 1e-6 * before.norm());
  }
}

TEST(Panorama, IsContinuousAcrossLayersWithItsGradient) {
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    PanoramaWorld world = cluttered_world();
    world.sensor.counting = counting;
    world.options.double_precision = true;
    world.box = {{-0.5, -0.3, 0.3}, {0.5, 0.3, 0.5}};  // layers are 0.05 m apart
    const Panorama panorama = world.panorama();
    for (const double layer_m : {0.35, 0.4, 0.45}) {
      constexpr double kAside_m = 1e-9;
      Eigen::Vector3d below, at, above;
      const double gain_at = panorama.gain({0.1, 0.07, layer_m}, at);
      const double gain_below = panorama.gain({0.1, 0.07, layer_m - kAside_m}, below);
      const double gain_above = panorama.gain({0.1, 0.07, layer_m + kAside_m}, above);
      EXPECT_NEAR(gain_below, gain_at, 1e-6 * gain_at);
      EXPECT_NEAR(gain_above, gain_at, 1e-6 * gain_at);
      EXPECT_LT((below - at).norm(), 1e-4 * at.norm());
      EXPECT_LT((above - at).norm(), 1e-4 * at.norm());
    }
  }
}

TEST(Panorama, IsSmoothedByAShareOfTheWidestTau) {
  PanoramaWorld world = cluttered_world();
  world.options.ray_spacing = 0.25;
  const Panorama narrow = world.panorama();
  world.options.smoothing = 32.0;
  const Panorama wide = world.panorama();
  double error = 0.0;
  double blur = 0.0;
  for (const JointPosition& q : random_places(world, 10)) {
    const double expected = narrow.gain(q);
    // The widest tau decides where the layers' rays lie, so that hits differ a little.
    EXPECT_NEAR(wide.gain(q, 1.0 / 32.0), expected, 5e-3 * expected);
    error += std::abs(wide.gain(q, 1.0 / 32.0) - expected);
    blur += std::abs(wide.gain(q) - expected);
  }
  EXPECT_GT(blur, 5.0 * error);
}

/// The values at some places, from a panorama that was asked about nothing else.
struct Fresh {
  JointPosition q;
  double gain;
  Eigen::Vector3d gradient;
};

std::vector<Fresh> fresh_values(const PanoramaWorld& world, int count) {
  std::vector<Fresh> values;
  for (const JointPosition& q : random_places(world, count)) {
    Fresh fresh{q, 0.0, {}};
    fresh.gain = world.panorama().gain(q, fresh.gradient);
    values.push_back(fresh);
  }
  return values;
}

class PanoramaValues : public ::testing::TestWithParam<Counting> {
 protected:
  PanoramaValues() {
    world_.sensor.counting = GetParam();
    // As many patches as keep several threads busy.
    world_.options.ray_spacing = 0.5;
  }

  static void expect_same_bits(const Panorama& panorama, const Fresh& fresh) {
    Eigen::Vector3d gradient;
    EXPECT_EQ(panorama.gain(fresh.q, gradient), fresh.gain);
    EXPECT_EQ(gradient, fresh.gradient);
  }

  PanoramaWorld world_ = cluttered_world();
};

TEST_P(PanoramaValues, DoNotDependOnWhatWasCastBefore) {
  const std::vector<Fresh> values = fresh_values(world_, 20);
  const Panorama used = world_.panorama();
  std::mt19937_64 random(99);
  for (int i = 0; i < 50; ++i) used.gain(world_.random_joints(random));
  for (const Fresh& fresh : values) expect_same_bits(used, fresh);
  const Panorama backwards = world_.panorama();
  std::for_each(values.rbegin(), values.rend(),
                [&](const Fresh& fresh) { expect_same_bits(backwards, fresh); });
}

TEST_P(PanoramaValues, AreTheSameForThreadsThatAskAtOnce) {
  const std::vector<Fresh> values = fresh_values(world_, 20);
  const Panorama shared = world_.panorama();
  std::thread other([&] {
    std::for_each(values.rbegin(), values.rend(),
                  [&](const Fresh& fresh) { expect_same_bits(shared, fresh); });
  });
  for (const Fresh& fresh : values) expect_same_bits(shared, fresh);
  other.join();
}

TEST_P(PanoramaValues, AreTheSameForTasksThatAskAtOnce) {
  const std::vector<Fresh> values = fresh_values(world_, 20);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(8);
  for (int round = 0; round < 10; ++round) {
    const Panorama shared = world_.panorama();
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, values.size(),
                        [&](std::size_t i) { expect_same_bits(shared, values[i]); });
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Counting, PanoramaValues,
                         ::testing::Values(Counting::per_ray, Counting::per_voxel),
                         [](const auto& variant) { return to_string(variant.param); });

/// The mean relative error against the exact gain of a sensor with this many times the rays.
double error_against_denser_sensor(const PanoramaWorld& world, const Panorama& panorama,
                                   const std::vector<JointPosition>& places, int times) {
  SensorOptions dense = world.sensor;
  dense.horizontal_rays *= times;
  dense.vertical_rays *= times;
  const auto exact = make_exact_evaluator(world.grid, DepthCamera(dense));
  double sum = 0.0;
  for (const JointPosition& q : places) {
    const double expected = exact->evaluate(world.T_map_sensor(q)).gain / (times * times);
    sum += std::abs(panorama.gain(q) - expected) / expected;
  }
  return sum / static_cast<double>(places.size());
}

TEST(Panorama, ConvergesToTheExactGainOfEverDenserSensors) {
  const UncertaintyMap map = read_map(datasets_dir() / "office_partial.ot");
  PanoramaWorld world;
  world.grid = VoxelGrid::whole(map);
  world.T_map_base = base_pose(1.93, 2.0, 0.0, 0.4);
  world.box = {{-2.0, -0.5, 0.4}, {2.0, 0.5, 0.4}};
  world.options.ray_spacing = 0.25;  // and a quarter of tau with it
  const Panorama panorama = world.panorama();
  const std::vector<JointPosition> places = random_places(world, 20);
  const auto error = [&](int times) {
    return error_against_denser_sensor(world, panorama, places, times);
  };
  const double sensors_own = error(1);
  const double at_3_times = error(3);
  const double at_10_times = error(10);  // 480 x 360 rays
  EXPECT_LT(at_3_times, 0.7 * sensors_own);
  EXPECT_LT(at_10_times, 0.7 * at_3_times);
  EXPECT_LT(at_10_times, 0.002);

  world.options = {};
  EXPECT_LT(at_10_times, 0.5 * error_against_denser_sensor(world, world.panorama(), places, 10))
      << "coarser layers are farther off";
  RecordProperty("error_of_48_x_36", std::to_string(sensors_own));
  RecordProperty("error_of_480_x_360", std::to_string(at_10_times));
}

TEST(Panorama, RefusesOptionsThatCannotBeUsed) {
  PanoramaWorld world = cluttered_world();
  world.options.ray_spacing = 0.0;
  EXPECT_EQ(message_of<InputError>([&] { world.panorama(); }),
            "panorama: ray_spacing must be a finite number above 0");
  world.options = {.layer_spacing = -1.0};
  EXPECT_EQ(message_of<InputError>([&] { world.panorama(); }),
            "panorama: layer_spacing must be a finite number above 0");
  world.options = {.smoothing = std::nan("")};
  EXPECT_EQ(message_of<InputError>([&] { world.panorama(); }),
            "panorama: smoothing must be a finite number above 0");
  world.options = {};
  world.sensor.horizontal_rays = 0;
  EXPECT_NE(message_of<InputError>([&] { world.panorama(); }), "");
}

}  // namespace
}  // namespace nbvopt::test
