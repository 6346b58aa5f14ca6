// Realised gains against sums by hand, and how well predictions meet them.
#include <gtest/gtest.h>

#include <cmath>

#include "nbvopt/map/scan.hpp"
#include "nbvopt/sim/prediction_record.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "sim/box_mesh.hpp"
#include "sim/realised_gain.hpp"
#include "support/camera_pose.hpp"

namespace nbvopt::test {
namespace {

/// A wall at x = 2.05, in the middle of a layer of voxels, and a camera before it.
class RealisedGain : public ::testing::Test {
 protected:
  static TriangleMesh wall() {
    TriangleMesh mesh;
    add_box(mesh, {2.05, -20.0, -20.0}, {2.5, 20.0, 20.0});
    return mesh;
  }

  double gain(const SensorOptions& sensor) const {
    const SimulatedCamera camera(scene_, sensor, 0.0, 1);
    return realised_gain(map_, DepthCamera(sensor), camera.planning_distances_m(pose_), pose_);
  }

  void look() {
    const SimulatedCamera camera(scene_, {}, 0.0, 1);
    insert_scan(map_, camera.capture(pose_, 0), pose_, {});
  }

  Scene scene_{wall()};
  UncertaintyMap map_{0.1};
  Transform pose_ = camera_at({0.0, 0.05, 0.05});
};

TEST_F(RealisedGain, IsAllThatRaysBringToAnEmptyMap) {
  const SensorOptions sensor;
  const UncertaintyModel model(sensor);
  const DepthCamera camera(sensor);
  double expected = 0.0;
  for (std::size_t i = 0; i < camera.rays().size(); ++i) {
    const Eigen::Vector3d direction = camera.rays().direction(i);
    expected += 1.0 - model.uncertainty(2.05 / direction.z() * direction);
  }
  EXPECT_NEAR(gain(sensor), expected, 1e-3);
}

TEST_F(RealisedGain, CountsEachVoxelOncePerVoxel) {
  SensorOptions sensor;
  sensor.counting = Counting::per_voxel;
  const double per_voxel = gain(sensor);
  const double voxels = (2.0 * 2.05 * std::tan(sensor.half_fov_horizontal_rad) / 0.1 + 1.0) *
                        (2.0 * 2.05 * std::tan(sensor.half_fov_vertical_rad) / 0.1 + 1.0);
  EXPECT_GT(per_voxel, 0.3 * voxels);
  EXPECT_LT(per_voxel, voxels);
  EXPECT_LT(per_voxel, gain({}));
}

TEST_F(RealisedGain, IsNothingWhereAllIsKnownAsWell) {
  look();
  EXPECT_NEAR(gain({}), 0.0, 1e-6);
}

TEST_F(RealisedGain, IsWhatABetterViewAdds) {
  look();
  pose_ = camera_at({0.8, 0.05, 0.05});
  const double closer = gain({});
  EXPECT_GT(closer, 0.0);
  EXPECT_LT(closer, 0.5 * 48 * 36);
}

TEST_F(RealisedGain, IsNothingOutOfRange) {
  pose_ = camera_at({-3.0, 0.05, 0.05});
  EXPECT_EQ(gain({}), 0.0);
  pose_ = camera_at({1.7, 0.05, 0.05});
  EXPECT_EQ(gain({}), 0.0);
}

TEST(PredictionRecord, CorrelatesAsPearsonDoes) {
  PredictionRecord record;
  EXPECT_TRUE(std::isnan(record.correlation()));
  EXPECT_TRUE(std::isnan(record.slope()));
  for (const auto& [x, y] : {std::pair{1.0, 2.0}, {2.0, 4.0}, {3.0, 3.0}, {4.0, 7.0}}) {
    record.add(x, y);
  }
  // By hand: sxx = 5, syy = 14, sxy = 7.
  EXPECT_NEAR(record.correlation(), 7.0 / std::sqrt(5.0 * 14.0), 1e-12);
  EXPECT_NEAR(record.bias(), 10.0 / 16.0 - 1.0, 1e-12);
  EXPECT_NEAR(record.slope(), 7.0 / 5.0, 1e-12);
}

TEST(PredictionRecord, KnowsNothingOfConstants) {
  PredictionRecord record;
  record.add(1.0, 0.0);
  record.add(2.0, 0.0);
  EXPECT_TRUE(std::isnan(record.correlation()));
  EXPECT_TRUE(std::isnan(record.bias()));
}

}  // namespace
}  // namespace nbvopt::test
