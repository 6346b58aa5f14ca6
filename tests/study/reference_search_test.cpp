#include "study/reference_search.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "nbvopt/planner/view_planner.hpp"
#include "support/oracle.hpp"
#include "support/paths.hpp"

namespace nbvopt::study {
namespace {

Reference search(double (*gain)(double pan, double tilt, double height), const JointBox& box) {
  return find_reference(
      [gain](const JointPosition& q) { return gain(q.pan_rad, q.tilt_rad, q.height_m); }, box);
}

TEST(ReferenceSearch, FindsASummitInside) {
  const Reference found = search(
      [](double pan, double tilt, double height) {
        return 100.0 - 30.0 * std::pow(pan - 0.3, 2) - 20.0 * std::pow(tilt + 0.1, 2) -
               50.0 * std::pow(height - 0.35, 2);
      },
      {{-1.0, -0.5, 0.2}, {1.0, 0.5, 0.5}});
  EXPECT_NEAR(found.gain, 100.0, 1e-4);
  EXPECT_NEAR(found.joints.pan_rad, 0.3, 2e-3);
  EXPECT_NEAR(found.joints.tilt_rad, -0.1, 2e-3);
  EXPECT_NEAR(found.joints.height_m, 0.35, 2e-3);
  EXPECT_TRUE(found.has_agreed);
  EXPECT_EQ(found.levels.size(), 2U);
}

TEST(ReferenceSearch, FindsASummitInACornerAndFrozenJoints) {
  const JointBox box{{-1.0, 0.2, 0.4}, {1.0, 0.2, 0.5}};
  const Reference found = search(
      [](double pan, double tilt, double height) { return 10.0 + pan + tilt + height; }, box);
  EXPECT_NEAR(found.gain, 11.7, 1e-9);
  EXPECT_EQ(found.joints.vector(), box.max);
}

TEST(ReferenceSearch, FindsThePeakThatAFirstLatticeMisses) {
  // 0.06 rad wide, between the points of the first lattice, beside a broad hill.
  const Reference found = search(
      [](double pan, double tilt, double) {
        const double hill = std::exp(-std::pow(pan + 0.5, 2) - std::pow(tilt, 2));
        const double peak = std::exp(-(std::pow(pan - 0.55, 2) + std::pow(tilt - 0.05, 2)) / 2e-3);
        return 100.0 * hill + 150.0 * peak;
      },
      {{-1.0, -0.5, 0.4}, {1.0, 0.5, 0.4}});
  EXPECT_GT(found.gain, 150.0);
  EXPECT_TRUE(found.has_agreed);
}

TEST(ReferenceSearch, IsDeterministic) {
  const auto rough = [](double pan, double tilt, double height) {
    return 100.0 + std::sin(40.0 * pan) + std::sin(50.0 * tilt) + std::sin(90.0 * height);
  };
  const JointBox box{{-0.5, -0.3, 0.3}, {0.5, 0.3, 0.5}};
  EXPECT_EQ(search(rough, box).gain, search(rough, box).gain);
}

/// The best views that another program found by brute force.
class KnownOptima : public testing::TestWithParam<const char*> {};

TEST_P(KnownOptima, AreReached) {
  const std::string file = std::string(GetParam()) + "_optima.json";
  NBVOPT_REQUIRE_ORACLE(file);
  const nlohmann::json oracle = test::read_oracle(file);
  Robot robot;
  robot.sensor = test::oracle_sensor(oracle);
  const ViewPlanner planner(read_map(test::oracle_map_file(oracle)), robot);
  const nlohmann::json& cases = oracle.at("cases");
  for (std::size_t i = 0; i < cases.size(); i += 4) {  // seconds each
    const nlohmann::json& known = cases[i];
    PlanRequest request;
    request.T_map_base = test::oracle_base(known);
    request.joints = test::oracle_joints(known);
    request.motion_time_s = known.at("time_budget_s");
    const MovingMast mast = moving_mast(request, planner.mast());
    const Reference found = find_reference(
        [&](const JointPosition& q) { return planner.evaluate(mast.T_map_sensor(q)).gain; },
        planner.reachable_box(request));
    EXPECT_GE(found.gain, known.at("best_gain").get<double>() * (1.0 - kReferenceAgreement));
    EXPECT_TRUE(found.has_agreed);
  }
}

INSTANTIATE_TEST_SUITE_P(All, KnownOptima,
                         testing::Values("ASLAM_lab", "apartment_partial", "office_partial"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace nbvopt::study
