#include <gmock/gmock.h>

#include <cmath>

#include "planner/sample_landscape.hpp"

namespace nbvopt {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::IsEmpty;

/// A gain of the direction of view and the height alone.
class Directions final : public ViewEvaluator {
 public:
  std::string name() const override { return "directions"; }
  ViewGain evaluate(const Transform& T_map_sensor) const override {
    const Eigen::Vector3d ahead = T_map_sensor.linear().col(2);
    ViewGain view;
    view.gain = 10.0 * std::atan2(ahead.y(), ahead.x()) + std::asin(ahead.z()) +
                100.0 * T_map_sensor.translation().z();
    return view;
  }
};

PlanResult result_in(const JointBox& box) {
  PlanResult result;
  result.box = box;
  result.joints = JointPosition::from(box.max);
  return result;
}

Landscape landscape_of(const JointBox& box) {
  return sample_landscape(Directions(), Mast(MastOptions{}), result_in(box));
}

TEST(Landscape, HoldsTheGainOfEveryPanAndTiltAtTheAnswersHeight) {
  const Landscape landscape = landscape_of({{-0.12, -0.2, 0.3}, {0.13, 0.09, 0.5}});
  EXPECT_EQ(landscape.height_m, 0.5);
  ASSERT_EQ(landscape.pan_rad.size(), 6U) << "0.05 rad apart or less";
  ASSERT_EQ(landscape.tilt_rad.size(), 7U);
  EXPECT_EQ(landscape.pan_rad.front(), -0.12);
  EXPECT_EQ(landscape.pan_rad.back(), 0.13);
  EXPECT_EQ(landscape.tilt_rad.front(), -0.2);
  EXPECT_EQ(landscape.tilt_rad.back(), 0.09);
  ASSERT_EQ(landscape.gain.size(), 42U);
  for (std::size_t tilt = 0; tilt < 7; ++tilt) {
    for (std::size_t pan = 0; pan < 6; ++pan) {
      EXPECT_NEAR(landscape.at(pan, tilt),
                  50.0 + 10.0 * landscape.pan_rad[pan] + landscape.tilt_rad[tilt], 1e-9);
    }
  }
}

TEST(Landscape, HasOneValueOfAFrozenJointAndTwoOfANarrowOne) {
  const Landscape landscape = landscape_of({{0.3, -0.01, 0.4}, {0.3, 0.01, 0.4}});
  EXPECT_THAT(landscape.pan_rad, ElementsAre(0.3));
  EXPECT_THAT(landscape.tilt_rad, ElementsAre(-0.01, 0.01));
  EXPECT_NEAR(landscape.interpolated(9.0, 0.0), 43.0, 1e-9) << "between the tilts, at the one pan";
}

TEST(Landscape, TakesNoMoreThanItsViews) {
  const Landscape landscape = landscape_of({{-40.0, -1.5, 0.4}, {40.0, 1.5, 0.4}});
  EXPECT_LE(landscape.gain.size(), 20000U);
  EXPECT_GT(landscape.gain.size(), 15000U);
}

TEST(Landscape, InterpolatesAndEndsAtItsEdges) {
  const Landscape landscape{0.4, {0.0, 1.0, 2.0}, {0.0, 0.5}, {0.0, 10.0, 20.0, 1.0, 11.0, 21.0}};
  EXPECT_DOUBLE_EQ(landscape.interpolated(0.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(landscape.interpolated(1.5, 0.25), 15.5);
  EXPECT_DOUBLE_EQ(landscape.interpolated(2.0, 0.5), 21.0);
  EXPECT_DOUBLE_EQ(landscape.interpolated(5.0, -1.0), 20.0);
}

TEST(Improvements, AreTheExactViewsBetterThanAllBefore) {
  std::vector<TracePoint> trace(5);
  const std::vector<double> gains{3.0, 2.0, 9.0, 3.0, 4.0};
  for (std::size_t i = 0; i < trace.size(); ++i) trace[i].gain = gains[i];
  trace[2].kind = EvaluationKind::surrogate;
  const std::vector<TracePoint> path = improvements(trace);
  ASSERT_EQ(path.size(), 2U);
  EXPECT_EQ(path[0].gain, 3.0);
  EXPECT_EQ(path[1].gain, 4.0);
}

TEST(CandidatePans, AreTheGridsUntilTheyLieTooClose) {
  const JointBox box{{-1.0, 0.0, 0.4}, {1.0, 0.0, 0.4}};
  EXPECT_THAT(candidate_pans(box, 0.8), ElementsAre(DoubleEq(-1.0), DoubleEq(-0.2), DoubleEq(0.6)));
  EXPECT_THAT(candidate_pans(box, 0.0), IsEmpty());
  EXPECT_THAT(candidate_pans(box, 0.01), IsEmpty());
}

}  // namespace
}  // namespace nbvopt
