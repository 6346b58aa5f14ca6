// The evaluators on the map that ships against gains that follow from the paper's equations: all
// rays of some views, derived by datasets/make_oracle.py, which shares nothing with this library,
// and two rays, derived by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/camera_pose.hpp"
#include "support/oracle.hpp"

namespace nbvopt {
namespace {

/// Rounding: the sums run in another order.
double rounding(double gain) { return 1e-9 * std::max(gain, 1.0); }

UncertaintyMap office() { return read_map(test::known_map_file("office_partial.ot")); }

TEST(DerivedGains, AreThoseOfThePaperCode) {
  const UncertaintyMap map = office();
  const nlohmann::json oracle = test::read_oracle("office_partial.json");
  const auto evaluator = make_paper_code_evaluator(map, test::oracle_sensor(oracle));
  const std::vector<Transform> poses = test::oracle_poses(oracle);
  ASSERT_EQ(poses.size(), 8U);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const nlohmann::json& known = oracle.at("cases").at(i);
    const double gain = known.at("gain");
    const ViewGain view = evaluator->evaluate(poses[i]);
    EXPECT_NEAR(view.gain, gain, rounding(gain)) << known;
    EXPECT_EQ(view.unknown_rays, known.at("unknown_rays").get<int>()) << known;
  }
}

TEST(DerivedGains, AreThoseOfTheExactEvaluatorOnEveryInstructionSet) {
  const nlohmann::json oracle = test::read_oracle("office_partial_optima.json");
  const DepthCamera camera(test::oracle_sensor(oracle));
  const UncertaintyMap map = office();
  const auto grid = VoxelGrid::lazy(map);
  const Mast mast{MastOptions{}};
  ASSERT_EQ(oracle.at("cases").size(), 8U);
  for (const SimdLevel level : supported_simd_levels()) {
    const auto exact = make_exact_evaluator(grid, camera, "paper", level);
    for (const nlohmann::json& known : oracle.at("cases")) {
      const auto gain_at = [&](const nlohmann::json& joints) {
        const Transform T_base_sensor = mast.T_base_sensor(test::oracle_joints(joints));
        return exact->evaluate(test::oracle_base(known) * T_base_sensor).gain;
      };
      const double current = known.at("current_gain");
      const double best = known.at("best_gain");
      EXPECT_NEAR(gain_at(known), current, rounding(current)) << to_string(level) << known;
      EXPECT_NEAR(gain_at(known.at("best")), best, rounding(best)) << to_string(level) << known;
    }
  }
}

// A camera at (1.82, 2.42, 0.42) looks along the map's y, two rays wide and one high: they leave at
// alpha_h = -0.5148721 and 0.5148721 (x/z = tan alpha_h = 0.5657727), alpha_v = 0. Samples lie at
// r = 0.5 + 0.05 i along the optical axis, at (1.82 + r x/z, 2.42 + r, 0.42) in the map.
//
// Left: the samples up to i = 54, (0.0095, 5.62), are free. The 55th, r = 3.25, (-0.0188, 5.67), is
// in the occupied voxel of x in [-0.05, 0) and y in [5.65, 5.7), whose stored u is 0.6995341.
//   d = r sqrt(1 + 0.5657727^2) = 3.7341054, d_F = 2.7341054            (1)
//   u_d = 1 - 2 / (1 + exp 2.7341054) = 0.8780188                       (2)
//   u_alpha = (0.5148721 / 0.52 + 0) / 2 = 0.4950693                    (3) to (7)
//   u_new = (0.8780188 + 0.4950693) / 2 = 0.6865440                     (8)
//   gain = 0.6995341 - 0.6865440 = 0.0129900                            (12)
// Right: the samples up to i = 61 are free. The 62nd, r = 3.6, (3.8568, 6.02), is unknown.
//   d = 4.1362399, d_F = 3.1362399, u_d = 0.9167262, u_new = 0.7058978
//   gain = 1 - 0.7058978 = 0.2941022                                    (12)
struct HandDerivedRay {
  double slope;  ///< x/z
  int samples;   ///< that are free
  VoxelState end;
  float stored_uncertainty;
};

TEST(HandDerivedRays, EndWhereTheyShould) {
  const UncertaintyMap map = office();
  for (const HandDerivedRay& ray :
       {HandDerivedRay{-0.5657727, 55, VoxelState::occupied, 0.6995341F},
        HandDerivedRay{0.5657727, 62, VoxelState::unknown, kUnknownUncertainty}}) {
    for (int i = 0; i <= ray.samples; ++i) {
      const double r = 0.5 + 0.05 * i;
      const VoxelRecord voxel = map.at(map.lattice().key({1.82 + r * ray.slope, 2.42 + r, 0.42}));
      if (i < ray.samples) {
        EXPECT_EQ(voxel.state, VoxelState::free) << i;
        continue;
      }
      EXPECT_EQ(voxel.state, ray.end);
      EXPECT_NEAR(voxel.uncertainty, ray.stored_uncertainty, 1e-7);
    }
  }
}

TEST(HandDerivedRays, AreThoseOfThePaperCode) {
  const UncertaintyMap map = office();
  SensorOptions sensor = test::oracle_sensor(test::read_oracle("office_partial.json"));
  sensor.horizontal_rays = 2;
  sensor.vertical_rays = 1;
  const ViewGain view = make_paper_code_evaluator(map, sensor)
                            ->evaluate(test::camera_at({1.82, 2.42, 0.42}, std::numbers::pi / 2.0));
  EXPECT_EQ(view.occupied_rays, 1);
  EXPECT_EQ(view.unknown_rays, 1);
  EXPECT_NEAR(view.occupied_gain, 0.0129900, 2e-7);
  EXPECT_NEAR(view.unknown_gain, 0.2941022, 2e-7);
}

}  // namespace
}  // namespace nbvopt
