// A bound on the gain of all views in reach, as answers carry it.
#include <gtest/gtest.h>

#include <algorithm>

#include "nbvopt/core/error.hpp"
#include "planner/planner_world.hpp"
#include "support/error_message.hpp"

namespace nbvopt::test {
namespace {

/// A free chamber of which one side is known to be a wall and the others are not known.
UncertaintyMap chamber() {
  UncertaintyMap map(0.1);
  const KeyBox inside = keys_between(map.lattice(), {-0.6, -0.6, 0.0}, {0.6, 0.6, 0.9});
  set_box(map, inside, kFree);
  set_box(map, keys_between(map.lattice(), {0.6, -0.6, 0.0}, {0.7, 0.6, 0.9}), occupied(0.6F));
  return map;
}

PlanRequest question() {
  PlanRequest request;
  request.joints = {0.0, 0.0, 0.4};
  request.motion_time_s = 0.3;
  request.certify.emplace();
  return request;
}

/// The most of many views in reach.
double best_of_views(const World& world, const PlanRequest& request, const JointBox& box,
                     int views) {
  std::mt19937_64 random(3);
  double best = 0.0;
  for (int i = 0; i < views; ++i) {
    Eigen::Vector3d q;
    for (int j = 0; j < 3; ++j) q[j] = uniform(random, box.min[j], box.max[j]);
    best = std::max(best, world.view(request, JointPosition::from(q)).gain);
  }
  return best;
}

PlanResult plan(const World& world, const PlanRequest& request) {
  return world.planner().plan(request, *make_solver("auto", {}));
}

TEST(Certify, TheGapIsMet) {
  const World world(chamber());
  PlanRequest request = question();
  request.certify->gap = 0.05;
  const PlanResult result = plan(world, request);
  ASSERT_TRUE(result.certificate);
  EXPECT_EQ(result.status, PlanStatus::certified);
  EXPECT_LE(result.certificate->gap(), 0.05);
  EXPECT_EQ(result.certificate->gain, result.view.gain);
  EXPECT_GE(result.certificate->upper_bound, best_of_views(world, request, result.box, 20'000));
}

TEST(Certify, ASmallerGapNeverLoosensTheBound) {
  const World world(chamber());
  PlanRequest request = question();
  double last = std::numeric_limits<double>::infinity();
  for (const double gap : {0.5, 0.2, 0.1, 0.05, 0.03}) {
    request.certify->gap = gap;
    const PlanResult result = plan(world, request);
    EXPECT_LE(result.certificate->upper_bound, last);
    last = result.certificate->upper_bound;
  }
}

TEST(Certify, HoldsWhenItIsStoppedAtOnce) {
  const World world(chamber());
  PlanRequest request = question();
  request.certify->gap = 0.0;
  for (const double limit_ms : {1e-6, 0.5, 2.0, 10.0}) {
    request.certify->time_limit_ms = limit_ms;
    const PlanResult result = plan(world, request);
    ASSERT_TRUE(result.certificate);
    EXPECT_NE(result.status, PlanStatus::certified);
    EXPECT_GE(result.certificate->upper_bound, best_of_views(world, request, result.box, 2'000));
    EXPECT_LE(result.certificate->upper_bound, 12 * 9);
  }
}

TEST(Certify, ImprovesABadAnswer) {
  const World world(chamber());
  PlanRequest request = question();
  request.joints.pan_rad = 0.3;      // towards the wall
  request.stop.max_evaluations = 1;  // staying
  const PlanResult result = plan(world, request);
  ASSERT_TRUE(result.certificate);
  EXPECT_GT(result.view.gain, result.current.gain);
  EXPECT_GT(result.certificate->improvements, 0);
  EXPECT_TRUE(result.box.contains(result.joints.vector()));
  EXPECT_EQ(world.view(request, result.joints).gain, result.view.gain);
}

TEST(Certify, EvaluationsAreCountedAndTraced) {
  const World world(chamber());
  PlanRequest request = question();
  request.record_trace = true;
  const PlanResult result = plan(world, request);
  EXPECT_EQ(std::ranges::count(result.trace, EvaluationKind::exact, &TracePoint::kind),
            result.evaluations);
}

TEST(Certify, NothingToGainIsBoundedToo) {
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-3.0, -3.0, -2.0}, {3.0, 3.0, 3.0}), kFree);
  const World world(map);
  const PlanResult result = plan(world, question());
  EXPECT_EQ(result.status, PlanStatus::no_gain_in_reach);
  EXPECT_EQ(result.certificate->upper_bound, 0.0);
  EXPECT_EQ(result.certificate->gap(), 0.0);
}

TEST(Certify, SaysTheSameAgain) {
  const World world(chamber());
  PlanRequest request = question();
  request.certify->gap = 0.04;
  const PlanResult first = plan(world, request);
  const PlanResult second = plan(world, request);
  EXPECT_EQ(first.certificate->upper_bound, second.certificate->upper_bound);
  EXPECT_EQ(first.certificate->cones, second.certificate->cones);
  EXPECT_EQ(first.joints, second.joints);
}

TEST(Certify, RefusesWhatCannotBe) {
  const World world(chamber());
  PlanRequest request = question();
  request.certify->gap = 1.0;
  EXPECT_EQ(message_of<InputError>([&] { plan(world, request); }),
            "certify.gap is 1, it must be a share from 0 to less than 1, such as 0.01");
  request.certify = {.gap = 0.01, .time_limit_ms = 0.0};
  EXPECT_EQ(message_of<InputError>([&] { plan(world, request); }),
            "certify.time_limit_ms is 0, it must be greater than 0 and at most 1e9");
  const World made_up(chamber(), [](double, double, double) { return 1.0; });
  EXPECT_EQ(message_of<UsageError>([&] { plan(made_up, question()); }),
            "only the gains positive and expected by the evaluator exact have a bound, and not "
            "positive by made-up");
}

}  // namespace
}  // namespace nbvopt::test
