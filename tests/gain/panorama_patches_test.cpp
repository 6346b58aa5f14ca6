// The shares of a panorama's patches, and the residuals that least squares see.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gain/panorama_world.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "nbvopt/planner/plan.hpp"
#include "planner/panorama_objective.hpp"
#include "support/error_message.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

struct Patches {
  Eigen::VectorXd gains;
  Eigen::MatrixXd derivatives;
};

Patches patches_at(const Panorama& panorama, const Eigen::Vector3d& q) {
  Patches patches;
  panorama.patch_gains(JointPosition::from(q), patches.gains, &patches.derivatives);
  return patches;
}

class PanoramaPatches : public ::testing::Test {
 protected:
  PanoramaPatches() { world_.options.double_precision = true; }

  PanoramaWorld world_ = cluttered_world();
  std::mt19937_64 random_{23};
};

TEST_F(PanoramaPatches, AddUpToTheGain) {
  world_.mast.sensor_offset_m = {0.06, 0.0, 0.02};
  const Panorama panorama = world_.panorama();
  for (int i = 0; i < 10; ++i) {
    const JointPosition q = world_.random_joints(random_);
    const Patches patches = patches_at(panorama, q.vector());
    EXPECT_EQ(patches.gains.size(), panorama.patch_count());
    Eigen::Vector3d gradient;
    const double gain = panorama.gain(q, gradient);
    EXPECT_NEAR(patches.gains.sum(), gain, 1e-9 * gain);
    const Eigen::Vector3d sum = patches.derivatives.colwise().sum();
    EXPECT_LT((sum - gradient).norm(), 1e-9 * gradient.norm());
    EXPECT_GE(patches.gains.minCoeff(), 0.0);
    EXPECT_LT(patches.gains.maxCoeff(), panorama.patch_gain_bound());

    Eigen::VectorXd alone;
    panorama.patch_gains(q, alone, nullptr);
    EXPECT_EQ(alone, patches.gains);
  }
}

TEST_F(PanoramaPatches, HaveTheDerivativesOfCentralDifferences) {
  constexpr double kStep = 1e-5;
  const Panorama panorama = world_.panorama();
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d q = world_.random_joints(random_).vector();
    const Patches patches = patches_at(panorama, q);
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(joint);
      const Eigen::VectorXd expected =
          (patches_at(panorama, q + step).gains - patches_at(panorama, q - step).gains) /
          (2.0 * kStep);
      EXPECT_LT((patches.derivatives.col(joint) - expected).norm(), 1e-4 * expected.norm());
    }
  }
}

TEST_F(PanoramaPatches, StayBelowTheirBound) {
  const UncertaintyMap office = read_map(datasets_dir() / "office_partial.ot");
  world_.box = {{-3.0, -0.79, 0.18}, {3.0, 0.79, 0.63}};
  world_.options.ray_spacing = 2.0;
  world_.options.layer_spacing = 6.0;  // hits are seen from nearer than they were cast from
  for (const auto& grid : {unknown_space(0.05), VoxelGrid::whole(office)}) {
    world_.grid = grid;
    for (const double y_m : {0.7, 1.7, 2.6}) {
      world_.T_map_base = base_pose(1.94, y_m, 0.0, 0.4);
      const Panorama panorama = world_.panorama();
      for (int i = 0; i < 50; ++i) {
        const Patches patches = patches_at(panorama, world_.random_joints(random_).vector());
        EXPECT_LT(patches.gains.maxCoeff(), panorama.patch_gain_bound());
      }
    }
  }
}

TEST_F(PanoramaPatches, AreRefusedPerVoxel) {
  world_.sensor.counting = Counting::per_voxel;
  const Panorama panorama = world_.panorama();
  EXPECT_NE(message_of<UsageError>([&] {
              patches_at(panorama, world_.joints.vector());
            }).find("per ray only"),
            std::string::npos);
}

class PanoramaResiduals : public PanoramaPatches {
 protected:
  const MovingMast mast_ = world_.moving_mast();
  const PanoramaObjective objective_{
      world_.grid,   world_.sensor, mast_, world_.box, planning_panorama(world_.sensor.counting),
      HazardTable(), nullptr};
};

TEST_F(PanoramaResiduals, SquareUpToAConstantLessTheValue) {
  std::vector<double> constants;
  for (int i = 0; i < 10; ++i) {
    const Point x = world_.random_joints(random_).vector();
    Eigen::VectorXd residuals;
    const double value = objective_.value_and_residuals(x, residuals, nullptr);
    ASSERT_EQ(residuals.size(), objective_.residual_count());
    EXPECT_NEAR(value, objective_.value(x), 1e-5 * value);
    constants.push_back(value + residuals.squaredNorm());
  }
  for (const double constant : constants) EXPECT_NEAR(constant, constants[0], 1e-9 * constants[0]);
}

TEST_F(PanoramaResiduals, HaveTheGradientOfTheValue) {
  for (int i = 0; i < 10; ++i) {
    const Point x = world_.random_joints(random_).vector();
    Eigen::VectorXd residuals;
    Eigen::MatrixXd jacobian;
    objective_.value_and_residuals(x, residuals, &jacobian);
    ASSERT_EQ(jacobian.rows(), residuals.size());
    ASSERT_EQ(jacobian.cols(), 3);
    Point gradient;
    objective_.value_and_gradient(x, gradient);
    // value = constant - r . r
    EXPECT_LT((-2.0 * jacobian.transpose() * residuals - gradient).norm(), 1e-4 * gradient.norm());
  }
}

TEST_F(PanoramaResiduals, HaveTheJacobianOfCentralDifferences) {
  constexpr double kStep = 3e-4;  // the sums are of single precision
  const auto residuals_at = [&](const Point& x) {
    Eigen::VectorXd residuals;
    objective_.value_and_residuals(x, residuals, nullptr);
    return residuals;
  };
  const Point x = world_.joints.vector();
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  objective_.value_and_residuals(x, residuals, &jacobian);
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    const Point step = kStep * Eigen::Vector3d::Unit(joint);
    const Eigen::VectorXd expected =
        (residuals_at(x + step) - residuals_at(x - step)) / (2.0 * kStep);
    EXPECT_LT((jacobian.col(joint) - expected).norm(), 1e-2 * expected.norm());
  }
}

TEST_F(PanoramaResiduals, AreThereOfPanoramasPerRayOnly) {
  EXPECT_TRUE(objective_.has_residuals());
  SensorOptions by_voxel = world_.sensor;
  by_voxel.counting = Counting::per_voxel;
  EXPECT_FALSE(PanoramaObjective(world_.grid, by_voxel, mast_, world_.box,
                                 planning_panorama(by_voxel.counting), HazardTable(), nullptr)
                   .has_residuals());
}

}  // namespace
}  // namespace nbvopt::test
