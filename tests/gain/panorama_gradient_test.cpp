// The panorama's gradient against central differences, and its precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "gain/panorama_world.hpp"

namespace nbvopt::test {
namespace {

constexpr double kStep = 1e-5;

Eigen::Vector3d central_differences(const Panorama& panorama, const JointPosition& q) {
  Eigen::Vector3d slope;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    slope[i] = (panorama.gain(JointPosition::from(q.vector() + step)) -
                panorama.gain(JointPosition::from(q.vector() - step))) /
               (2.0 * kStep);
  }
  return slope;
}

/// Whether one joint takes clearly longest: elsewhere the time of arrival has a kink.
bool is_smooth(const PanoramaWorld& world, const JointPosition& q) {
  if (world.base_twist.is_zero()) return true;
  Eigen::Array3d times_s =
      (q.vector() - world.joints.vector()).cwiseAbs().array() / Mast(world.mast).velocity().array();
  std::sort(times_s.begin(), times_s.end());
  return times_s[2] - times_s[1] > 1e-3;
}

std::vector<JointPosition> smooth_places(const PanoramaWorld& world, int count) {
  // Per voxel the sum has kinks and steps, at about one place in five hundred: none is among these.
  std::mt19937_64 random(14);
  std::vector<JointPosition> places;
  while (std::ssize(places) < count) {
    const JointPosition q = world.random_joints(random);
    if (is_smooth(world, q)) places.push_back(q);
  }
  return places;
}

struct Variant {
  std::string name;
  std::function<void(PanoramaWorld&)> change;
};

class PanoramaGradient : public ::testing::TestWithParam<Variant> {
 protected:
  PanoramaGradient() : world_(cluttered_world()) { GetParam().change(world_); }

  PanoramaWorld world_;
};

TEST_P(PanoramaGradient, IsThatOfCentralDifferences) {
  world_.options.double_precision = true;
  const Panorama panorama = world_.panorama();
  double error = 0.0;
  double norm = 0.0;
  for (const JointPosition& q : smooth_places(world_, 30)) {
    const Eigen::Vector3d expected = central_differences(panorama, q);
    Eigen::Vector3d gradient;
    const double gain = panorama.gain(q, gradient);
    EXPECT_NEAR(gain, panorama.gain(q), 1e-9 * gain);
    EXPECT_LT((gradient - expected).norm(), 1e-3 * expected.norm())
        << "at " << q.vector().transpose();
    error += (gradient - expected).squaredNorm();
    norm += expected.squaredNorm();
  }
  EXPECT_LT(std::sqrt(error / norm), 1e-4);
}

TEST_P(PanoramaGradient, IsThatOfDoublePrecision) {
  const Panorama single = world_.panorama();
  world_.options.double_precision = true;
  const Panorama exact = world_.panorama();
  for (const JointPosition& q : smooth_places(world_, 30)) {
    Eigen::Vector3d gradient, expected;
    const double expected_gain = exact.gain(q, expected);
    EXPECT_NEAR(single.gain(q, gradient), expected_gain, 1e-5 * expected_gain);
    EXPECT_NEAR(single.gain(q), expected_gain, 1e-5 * expected_gain);
    EXPECT_LT((gradient - expected).norm(), 1e-4 * expected.norm()) << q.vector().transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Variants, PanoramaGradient,
    ::testing::Values(
        Variant{"per_ray", [](PanoramaWorld&) {}},
        Variant{"per_voxel",
                [](PanoramaWorld& world) { world.sensor.counting = Counting::per_voxel; }},
        Variant{"narrow_edges", [](PanoramaWorld& world) { world.options.smoothing = 0.5; }},
        Variant{"lever_arm",
                [](PanoramaWorld& world) {
                  world.mast.sensor_offset_m = {0.06, -0.03, 0.04};
                }},
        Variant{"moving_base",
                [](PanoramaWorld& world) {
                  world.base_twist = {0.3, -0.2, 0.8};
                }},
        Variant{"turning_base",
                [](PanoramaWorld& world) {
                  world.base_twist = {0.0, 0.0, -1.2};
                }},
        Variant{"lever_arm_per_voxel",
                [](PanoramaWorld& world) {
                  world.sensor.counting = Counting::per_voxel;
                  world.mast.sensor_offset_m = {0.06, -0.03, 0.04};
                }},
        Variant{"lever_arm_on_moving_base_with_mast_beside",
                [](PanoramaWorld& world) {
                  world.base_twist = {0.3, -0.2, 0.8};
                  world.mast.pan_axis_x_m = -0.1;
                  world.mast.pan_axis_y_m = 0.06;
                  world.mast.sensor_offset_m = {0.06, -0.03, 0.04};
                }},
        Variant{"equal_angles",
                [](PanoramaWorld& world) { world.sensor.ray_pattern = RayPattern::equal_angles; }},
        Variant{"z_depth",
                [](PanoramaWorld& world) { world.sensor.range_axis = RangeAxis::z_depth; }},
        Variant{"paper_code",
                [](PanoramaWorld& world) { world.sensor = paper_code_sensor(world.sensor); }},
        Variant{"normals", [](PanoramaWorld& world) { world.sensor.normal_weight = 0.4; }},
        Variant{"expected_normals",
                [](PanoramaWorld& world) {
                  world.sensor.normal_weight = 0.4;
                  world.sensor.gain = GainKind::expected;
                }},
        Variant{"distance_alone",
                [](PanoramaWorld& world) {
                  world.sensor.uncertainty_mode = UncertaintyMode::distance;
                }},
        Variant{
            "angle_alone",
            [](PanoramaWorld& world) { world.sensor.uncertainty_mode = UncertaintyMode::angle; }}),
    [](const auto& variant) { return variant.param.name; });

}  // namespace
}  // namespace nbvopt::test
