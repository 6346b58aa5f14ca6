// The evaluators against the gains that the paper's authors' own code gave, and, on the map that
// ships, against those that follow from the equations (datasets/make_oracle.py).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

using test::oracle_poses;
using test::oracle_sensor;
using test::read_oracle;

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), static_cast<Eigen::Index>(a.size()));
  const Eigen::Map<const Eigen::ArrayXd> y(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::ArrayXd dx = x - x.mean();
  const Eigen::ArrayXd dy = y - y.mean();
  return (dx * dy).sum() / std::sqrt(dx.square().sum() * dy.square().sum());
}

class PaperCode : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string file = std::string(GetParam()) + ".json";
    NBVOPT_REQUIRE_ORACLE(file);
    oracle_ = read_oracle(file);
    sensor_ = oracle_sensor(oracle_);
    poses_ = oracle_poses(oracle_);
    map_.emplace(read_map(test::oracle_map_file(oracle_)));
  }

  nlohmann::json oracle_;
  SensorOptions sensor_;
  std::vector<Transform> poses_;
  std::optional<UncertaintyMap> map_;
};

TEST_P(PaperCode, GivesTheRecordedGainsAndCounts) {
  const auto evaluator = make_paper_code_evaluator(*map_, sensor_);
  double relative_error_sum = 0.0;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const nlohmann::json& known = oracle_.at("cases").at(i);
    const double gain = known.at("gain");
    const ViewGain view = evaluator->evaluate(poses_[i]);
    EXPECT_NEAR(view.gain, gain, std::max(1e-3 * gain, 0.5)) << "case " << i;
    EXPECT_EQ(view.unknown_rays, known.at("unknown_rays").get<int>()) << "case " << i;
    relative_error_sum += std::abs(view.gain - gain) / std::max(gain, 1.0);
  }
  EXPECT_LT(relative_error_sum / static_cast<double>(poses_.size()), 1e-4);
}

TEST_P(PaperCode, GivesTheSameForBaseAndJoints) {
  const auto evaluator = make_paper_code_evaluator(*map_, sensor_);
  const Mast mast{MastOptions{}};
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const nlohmann::json& known = oracle_.at("cases").at(i);
    const Transform T_map_sensor =
        test::oracle_base(known) * mast.T_base_sensor(test::oracle_joints(known));
    EXPECT_TRUE(T_map_sensor.isApprox(poses_[i], 1e-9)) << "case " << i;
  }
}

TEST_P(PaperCode, CorrelatesWithTheExactGain) {
  const auto exact = make_exact_evaluator(VoxelGrid::lazy(*map_), DepthCamera(sensor_));
  std::vector<double> recorded, evaluated;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    recorded.push_back(oracle_.at("cases").at(i).at("gain"));
    evaluated.push_back(exact->evaluate(poses_[i]).gain);
  }
  EXPECT_GT(correlation(recorded, evaluated), 0.998);
}

TEST_P(PaperCode, NeverHitsBeforeTheExactRay) {
  const auto grid = VoxelGrid::lazy(*map_);
  const CameraRays camera = make_rays(sensor_, sensor_.horizontal_rays, sensor_.vertical_rays);
  RayHits hits;
  for (const Transform& pose : poses_) {
    const RayBundle rays = make_bundle(camera, pose, false);
    cast_rays(*grid, rays, 1.0, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3d unit_depth = camera.direction(i) / camera.z[i];
      for (int k = 0;; ++k) {
        const double depth_m = sensor_.range_min_m + k * map_->resolution_m();
        if (depth_m >= sensor_.range_max_m) break;
        const Eigen::Vector3d p_map = pose * (depth_m * unit_depth);
        if (map_->at(map_->lattice().key(p_map)).state == VoxelState::free) continue;
        // A sample within rounding of a voxel's face may be ahead of the ray that enters there.
        const double sample_distance_m = depth_m * unit_depth.norm();
        ASSERT_GE(hits.kind[i], HitKind::unknown) << "the exact ray passed what a sample hit";
        ASSERT_LE(hits.distance_m[i], sample_distance_m + 1e-6);
        break;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Maps, PaperCode,
                         ::testing::Values("ASLAM_lab", "apartment_partial", "warehouse_partial",
                                           "office_partial"));

}  // namespace
}  // namespace nbvopt
