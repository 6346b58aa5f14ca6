// The exact gain where it can be worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "support/camera_pose.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// 35 rays, which no vector divides.
SensorOptions small_sensor() {
  SensorOptions sensor;
  sensor.horizontal_rays = 7;
  sensor.vertical_rays = 5;
  return sensor;
}

/// One ray straight ahead.
SensorOptions one_ray() {
  SensorOptions sensor;
  sensor.horizontal_rays = 1;
  sensor.vertical_rays = 1;
  return sensor;
}

/// Equations (1) to (8) once more, as the paper writes them.
double u_by_hand(const SensorOptions& sensor, const Eigen::Vector3d& p) {
  const double u_d = 1.0 - 2.0 / (1.0 + std::exp(std::abs(p.norm() - sensor.focal_distance_m)));
  const double u_h = std::abs(std::atan(p.x() / p.z())) / sensor.half_fov_horizontal_rad;
  const double u_v = std::abs(std::atan(p.y() / p.z())) / sensor.half_fov_vertical_rad;
  const double u_alpha = 0.5 * (u_h + u_v);
  switch (sensor.uncertainty_mode) {
    case UncertaintyMode::distance:
      return u_d;
    case UncertaintyMode::angle:
      return u_alpha;
    case UncertaintyMode::both:
      break;
  }
  return 0.5 * (u_d + u_alpha);
}

/// The sum over the sensor's rays of what a ray in this direction gains.
double sum_over_rays(const SensorOptions& sensor,
                     const std::function<double(const Eigen::Vector3d&)>& gain_of) {
  const CameraRays rays = make_rays(sensor, sensor.horizontal_rays, sensor.vertical_rays);
  double sum = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) sum += gain_of(rays.direction(i));
  return sum;
}

const Eigen::Vector3d kCamera_m(0.03, 0.02, 0.01);

/// Free space around the camera at 0.1 m, and before it, from wall_x_m on, a wall.
UncertaintyMap room_with_wall(double wall_x_m, const VoxelRecord& wall) {
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-0.5, -2.0, -1.5}, {wall_x_m, 2.0, 1.5}), kFree);
  if (wall.state != VoxelState::unknown) {
    set_box(map, keys_between(map.lattice(), {wall_x_m, -2.0, -1.5}, {wall_x_m + 0.3, 2.0, 1.5}),
            wall);
  }
  map.finish_writing();
  return map;
}

ViewGain evaluate(const UncertaintyMap& map, const SensorOptions& sensor,
                  SimdLevel level = SimdLevel::best) {
  return make_exact_evaluator(VoxelGrid::lazy(map), DepthCamera(sensor), "paper", level)
      ->evaluate(camera_at(kCamera_m));
}

TEST(ExactEvaluator, GivesOneRayInTheVoidItsWorkedNumber) {
  const ViewGain view = evaluate(UncertaintyMap(0.1), one_ray());
  // 1 - u_d / 2 at 0.5 m, half a metre before the focus.
  EXPECT_NEAR(view.gain, 1.0 - 0.2449186624037092 / 2.0, 1e-12);
  EXPECT_EQ(view.unknown_rays, 1);
}

TEST(ExactEvaluator, SeesAnEmptyMapAtTheNearEnd) {
  const SensorOptions sensor = small_sensor();
  const UncertaintyMap nothing(0.1);
  for (const SimdLevel level : supported_simd_levels()) {
    const ViewGain view = evaluate(nothing, sensor, level);
    EXPECT_NEAR(
        view.gain,
        sum_over_rays(sensor,
                      [&](const Eigen::Vector3d& d) { return 1.0 - u_by_hand(sensor, 0.5 * d); }),
        1e-10);
    EXPECT_EQ(view.unknown_gain, view.gain);
    EXPECT_EQ(view.occupied_gain, 0.0);
    EXPECT_EQ(view.unknown_rays, 35);
    EXPECT_EQ(view.occupied_rays + view.free_rays, 0);
  }
}

TEST(ExactEvaluator, FindsNothingWhereAllIsKnown) {
  const UncertaintyMap map = room_with_wall(2.0, occupied(0.0F));
  const ViewGain view = evaluate(map, small_sensor());
  EXPECT_EQ(view.gain, 0.0);
  EXPECT_EQ(view.occupied_rays, 35);
  EXPECT_EQ(view.unknown_rays + view.free_rays, 0);
}

TEST(ExactEvaluator, FindsNothingWhereAllIsFree) {
  SensorOptions sensor = small_sensor();
  sensor.range_max_m = 1.5;
  const ViewGain view = evaluate(room_with_wall(2.0, occupied(1.0F)), sensor);
  EXPECT_EQ(view.gain, 0.0);
  EXPECT_EQ(view.free_rays, 35);
}

/// Equation (12) for a wall 1.97 m before the camera, in every mode.
TEST(ExactEvaluator, SeesAWallAtItsDistance) {
  SensorOptions sensor = small_sensor();
  constexpr double kDepth_m = 1.97;
  for (const UncertaintyMode mode :
       {UncertaintyMode::distance, UncertaintyMode::angle, UncertaintyMode::both}) {
    sensor.uncertainty_mode = mode;
    for (const VoxelRecord& wall :
         {VoxelRecord{}, occupied(0.96875F), occupied(0.5F), occupied(0.125F)}) {
      const bool is_unknown = wall.state == VoxelState::unknown;
      const double expected = sum_over_rays(sensor, [&](const Eigen::Vector3d& d) {
        return std::max(0.0, wall.uncertainty - u_by_hand(sensor, d / d.z() * kDepth_m));
      });
      const UncertaintyMap map = room_with_wall(2.0, wall);
      for (const SimdLevel level : supported_simd_levels()) {
        const ViewGain view = evaluate(map, sensor, level);
        EXPECT_NEAR(view.gain, expected, 1e-9) << to_string(mode) << ' ' << to_string(level);
        EXPECT_EQ(is_unknown ? view.unknown_gain : view.occupied_gain, view.gain);
        EXPECT_EQ(is_unknown ? view.unknown_rays : view.occupied_rays, 35);
      }
    }
  }
}

/// One ray ahead, the camera 0.03 m into a voxel of 0.1 m, D_min 0.5: the point at D_min is at
/// 0.53, in the voxel that starts at 0.5.
class NearField : public ::testing::Test {
 protected:
  static ViewGain view_behind(int voxels_ahead, const VoxelRecord& record, bool near_blocking) {
    UncertaintyMap map = room_with_wall(2.0, occupied(1.0F));
    if (record.state != VoxelState::unknown) {
      map.set(key_from_origin(voxels_ahead, 0, 0), record);
      map.finish_writing();
    } else {
      // Nothing can be taken out of a map: make it anew without the voxel.
      UncertaintyMap with_hole(0.1);
      for_each_key(*map.known_box(), [&](VoxelKey key) {
        if (key != key_from_origin(voxels_ahead, 0, 0)) with_hole.set(key, map.at(key));
      });
      with_hole.finish_writing();
      map = std::move(with_hole);
    }
    SensorOptions sensor = one_ray();
    sensor.near_blocking = near_blocking;
    return evaluate(map, sensor);
  }

  static constexpr double kWall_m = 1.97;
};

TEST_F(NearField, IsBlockedByAnOccupiedVoxel) {
  for (int ahead = 0; ahead < 5; ++ahead) {
    const ViewGain blocked = view_behind(ahead, occupied(1.0F), true);
    EXPECT_EQ(blocked.gain, 0.0) << ahead;
    EXPECT_EQ(blocked.free_rays, 1);
    const ViewGain passed = view_behind(ahead, occupied(1.0F), false);
    EXPECT_NEAR(passed.gain, 1.0 - u_by_hand(one_ray(), {0, 0, kWall_m}), 1e-12) << ahead;
    EXPECT_EQ(passed.occupied_rays, 1);
  }
}

TEST_F(NearField, IsPassedWhereUnknownOrFree) {
  for (int ahead = 0; ahead < 5; ++ahead) {
    for (const VoxelRecord& record : {VoxelRecord{}, kFree}) {
      const ViewGain view = view_behind(ahead, record, true);
      EXPECT_NEAR(view.gain, 1.0 - u_by_hand(one_ray(), {0, 0, kWall_m}), 1e-12) << ahead;
      EXPECT_EQ(view.occupied_rays, 1);
    }
  }
}

TEST_F(NearField, EndsBeforeTheVoxelThatHoldsThePointAtTheNearEnd) {
  for (const bool near_blocking : {true, false}) {
    const ViewGain occupied_there = view_behind(5, occupied(1.0F), near_blocking);
    EXPECT_NEAR(occupied_there.gain, 1.0 - u_by_hand(one_ray(), {0, 0, 0.5}), 1e-12);
    EXPECT_EQ(occupied_there.occupied_rays, 1);
    const ViewGain unknown_there = view_behind(5, {}, near_blocking);
    EXPECT_NEAR(unknown_there.gain, 1.0 - u_by_hand(one_ray(), {0, 0, 0.5}), 1e-12);
    EXPECT_EQ(unknown_there.unknown_rays, 1);
  }
}

/// Three rays, side by side, on one voxel of a wall 1.97 m ahead.
TEST(ExactEvaluator, CountsAVoxelOnceWithItsBestRay) {
  SensorOptions sensor;
  sensor.half_fov_horizontal_rad = 0.01;
  sensor.half_fov_vertical_rad = 0.01;
  sensor.horizontal_rays = 3;
  sensor.vertical_rays = 1;
  const auto gain_of = [&](double tangent_x) {
    return 1.0 - u_by_hand(sensor, Eigen::Vector3d(tangent_x, 0.0, 1.0) * 1.97);
  };
  const double outer = std::tan(0.01) * 2.0 / 3.0;
  const UncertaintyMap map = room_with_wall(2.0, occupied(1.0F));

  const ViewGain per_ray = evaluate(map, sensor);
  EXPECT_NEAR(per_ray.gain, gain_of(0.0) + 2.0 * gain_of(outer), 1e-12);
  sensor.counting = Counting::per_voxel;
  const ViewGain per_voxel = evaluate(map, sensor);
  EXPECT_NEAR(per_voxel.gain, gain_of(0.0), 1e-12);
  EXPECT_EQ(per_voxel.occupied_gain, per_voxel.gain);
  EXPECT_EQ(per_voxel.occupied_rays, 3) << "rays are counted as they are";

  // With the left and the right ray on voxels of their own, all three count.
  sensor.half_fov_horizontal_rad = 0.3;
  const double far_out = std::tan(0.3) * 2.0 / 3.0;
  EXPECT_NEAR(evaluate(map, sensor).gain, gain_of(0.0) + 2.0 * gain_of(far_out), 1e-12);
}

TEST(ExactEvaluator, TakesTheGivenUncertaintyWhereTheMapCarriesNone) {
  SensorOptions sensor = one_ray();
  sensor.occupied_uncertainty = 0.75;
  const double u_new = u_by_hand(sensor, {0, 0, 1.97});
  UncertaintyMap map = room_with_wall(2.0, occupied(1.0F));
  EXPECT_NEAR(evaluate(map, sensor).gain, 0.75 - u_new, 1e-12);
  map.set(map.lattice().key({2.25, 1.45, 1.45}), occupied(0.5F));
  map.finish_writing();
  EXPECT_NEAR(evaluate(map, sensor).gain, 1.0 - u_new, 1e-12);
}

class ExactEvaluatorInClutter : public ::testing::Test {
 protected:
  ExactEvaluatorInClutter() : map_(0.1) {
    std::mt19937_64 random(17);
    scatter(map_, cube(key_from_origin(-40, -40, -40), 80), 0.01, random);
    map_.finish_writing();
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3d position_m(uniform(random, -2, 2), uniform(random, -2, 2),
                                       uniform(random, -2, 2));
      poses_.push_back(camera_at(position_m, uniform(random, -3, 3), uniform(random, -1, 1)));
    }
  }

  std::unique_ptr<ViewEvaluator> evaluator(const SensorOptions& sensor) const {
    return make_exact_evaluator(VoxelGrid::lazy(map_), DepthCamera(sensor));
  }

  UncertaintyMap map_;
  std::vector<Transform> poses_;
};

/// Equation (13) over voxels, with a table of them.
TEST_F(ExactEvaluatorInClutter, CountsEveryVoxelOnce) {
  SensorOptions sensor;
  const auto per_ray = evaluator(sensor);
  sensor.counting = Counting::per_voxel;
  const auto per_voxel = evaluator(sensor);
  const CameraRays rays = DepthCamera(sensor).rays();
  const auto grid = VoxelGrid::lazy(map_);
  bool any_voxel_twice = false;
  for (const Transform& T_map_sensor : poses_) {
    RayHits hits;
    cast_rays(*grid, {T_map_sensor, rays.x, rays.y, rays.z, rays.range_min_m, rays.range_max_m},
              1.0, hits);
    std::map<std::uint64_t, double> best;
    double all = 0.0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits.kind[i] < HitKind::unknown) continue;
      const double u_new = u_by_hand(sensor, rays.direction(i) * hits.distance_m[i]);
      const double gain = std::max(0.0, hits.uncertainty[i] - u_new);
      double& entry = best[packed(hits.voxel[i])];
      any_voxel_twice |= entry > 0.0;
      entry = std::max(entry, gain);
      all += gain;
    }
    double once = 0.0;
    for (const auto& [voxel, gain] : best) once += gain;
    const ViewGain of_rays = per_ray->evaluate(T_map_sensor);
    const ViewGain of_voxels = per_voxel->evaluate(T_map_sensor);
    EXPECT_NEAR(of_rays.gain, all, 1e-9 * all);
    EXPECT_NEAR(of_voxels.gain, once, 1e-9 * once);
    EXPECT_LE(of_voxels.gain, of_rays.gain);
    for (const ViewGain& view : {of_rays, of_voxels}) {
      EXPECT_DOUBLE_EQ(view.unknown_gain + view.occupied_gain, view.gain);
      EXPECT_EQ(view.unknown_rays,
                std::count(hits.kind.begin(), hits.kind.end(), HitKind::unknown));
      EXPECT_EQ(view.occupied_rays,
                std::count(hits.kind.begin(), hits.kind.end(), HitKind::occupied));
      EXPECT_EQ(view.unknown_rays + view.occupied_rays + view.free_rays, 48 * 36);
    }
  }
  EXPECT_TRUE(any_voxel_twice);
}

TEST_F(ExactEvaluatorInClutter, GivesTheSameForAnyNumberOfThreads) {
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    SensorOptions sensor;
    sensor.counting = counting;
    const auto exact = evaluator(sensor);
    const std::vector<ViewGain> one = evaluate_views(*exact, poses_, 1);
    EXPECT_EQ(evaluate_views(*exact, poses_, 2), one);
    EXPECT_EQ(evaluate_views(*exact, poses_, 0), one);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      EXPECT_EQ(exact->evaluate(poses_[i]), one[i]);
    }
  }
}

TEST_F(ExactEvaluatorInClutter, LeavesTheRestNotEvaluatedWhenStopped) {
  const auto exact = evaluator(SensorOptions{});
  StopRule cancelled;
  cancelled.cancel.cancel();
  StopRule expired;
  expired.deadline = StopRule::Clock::now();
  for (const StopRule& stop : {cancelled, expired}) {
    for (const int threads : {1, 2}) {
      const std::vector<ViewGain> views = evaluate_views(*exact, poses_, threads, stop);
      ASSERT_EQ(views.size(), poses_.size());
      for (const ViewGain& view : views) EXPECT_TRUE(std::isnan(view.gain));
    }
  }
}

/// Cancels when it has evaluated a few views.
class CancellingEvaluator final : public ViewEvaluator {
 public:
  explicit CancellingEvaluator(const CancelToken& cancel) : cancel_(cancel) {}
  std::string name() const override { return "cancelling"; }
  ViewGain evaluate(const Transform& T_map_sensor) const override {
    const double x_m = T_map_sensor.translation().x();
    if (x_m == 3.0) cancel_.cancel();
    ViewGain view;
    view.gain = x_m;
    return view;
  }

 private:
  CancelToken cancel_;
};

TEST(EvaluateViews, KeepsWhatWasEvaluatedBeforeItWasStopped) {
  const StopRule stop;
  const CancellingEvaluator evaluator(stop.cancel);
  std::vector<Transform> poses;
  for (int i = 0; i < 6; ++i) poses.push_back(camera_at({double(i), 0.0, 0.0}));
  const std::vector<ViewGain> views = evaluate_views(evaluator, poses, 1, stop);
  for (int i = 0; i < 6; ++i) {
    if (i <= 3) {
      EXPECT_EQ(views[i].gain, i);
    } else {
      EXPECT_TRUE(std::isnan(views[i].gain)) << i;
    }
  }
}

TEST(ExactEvaluator, RefusesAPoseThatIsNone) {
  const auto exact =
      make_exact_evaluator(VoxelGrid::whole(UncertaintyMap(0.1)), DepthCamera(SensorOptions{}));
  EXPECT_THROW(exact->evaluate(camera_at({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0})),
               InputError);
  EXPECT_THROW(exact->evaluate(camera_at({4000.0, 0.0, 0.0})), InputError);
  const std::vector<Transform> poses{camera_at({0.0, 0.0, 0.0}), camera_at({4000.0, 0.0, 0.0})};
  EXPECT_THROW(evaluate_views(*exact, poses, 2), InputError);
}

}  // namespace
}  // namespace nbvopt::test
