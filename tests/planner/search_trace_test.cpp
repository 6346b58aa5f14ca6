#include "planner/search_trace.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <thread>

#include "planner/planner_world.hpp"
#include "support/numbers.hpp"

namespace nbvopt::test {
namespace {

using ::testing::IsEmpty;

TEST(SearchTrace, KeepsTheBestExactGainOnly) {
  SearchTrace trace(StopRule::Clock::now());
  trace.record(EvaluationKind::surrogate, {0.1, 0.0, 0.4}, 9.0);
  trace.record(EvaluationKind::exact, {0.2, 0.0, 0.4}, 5.0);
  trace.record(EvaluationKind::exact, {0.3, 0.0, 0.4}, kNaN);
  trace.record(EvaluationKind::exact, {0.4, 0.0, 0.4}, 4.0);
  trace.record(EvaluationKind::surrogate, {0.5, 0.0, 0.4}, 9.0);
  trace.record(EvaluationKind::exact, {0.6, 0.0, 0.4}, 6.0);
  const std::vector<TracePoint> points = trace.points();
  ASSERT_EQ(points.size(), 6U);
  EXPECT_TRUE(std::isnan(points[0].best_gain));
  EXPECT_EQ(points[0].kind, EvaluationKind::surrogate);
  EXPECT_EQ(points[0].gain, 9.0);
  EXPECT_EQ(points[1].joints, (JointPosition{0.2, 0.0, 0.4}));
  EXPECT_EQ(points[1].best_gain, 5.0);
  EXPECT_EQ(points[2].best_gain, 5.0) << "NaN is worse than any value";
  EXPECT_EQ(points[3].best_gain, 5.0);
  EXPECT_EQ(points[4].best_gain, 5.0) << "a surrogate's gain is no gain";
  EXPECT_EQ(points[5].best_gain, 6.0);
}

TEST(SearchTrace, TakesWhatManyThreadsRecord) {
  SearchTrace trace(StopRule::Clock::now());
  constexpr int kThreads = 4;
  constexpr int kRecords = 1000;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < kRecords; ++i) trace.record(EvaluationKind::exact, {}, i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::vector<TracePoint> points = trace.points();
  ASSERT_EQ(points.size(), std::size_t(kThreads * kRecords));
  for (std::size_t i = 1; i < points.size(); ++i) {
    ASSERT_GE(points[i].best_gain, points[i - 1].best_gain);
    ASSERT_GE(points[i].time_ms, points[i - 1].time_ms);
  }
}

TEST(Planner, RecordsItsSearchOnRequest) {
  const World world(free_cube(),
                    [](double yaw, double, double) { return 100.0 + std::cos(yaw - 0.75); });
  PlanRequest request = request_at(kMiddle, 0.5);
  EXPECT_THAT(world.planner().plan(request, *pan_grid(0.25)).trace, IsEmpty());

  request.record_trace = true;
  const PlanResult result = world.planner().plan(request, *pan_grid(0.25));
  expect_contract(world, request, result);
  ASSERT_EQ(result.trace.size(), std::size_t(result.evaluations));
  EXPECT_EQ(result.surrogate_evaluations, 0);
  for (std::size_t i = 0; i < result.trace.size(); ++i) {
    const TracePoint& point = result.trace[i];
    EXPECT_EQ(point.kind, EvaluationKind::exact);
    EXPECT_EQ(point.gain, world.view(request, point.joints).gain);
    EXPECT_GE(point.best_gain, point.gain);
    EXPECT_LE(point.time_ms, result.search_time_ms);
    if (i > 1) {
      EXPECT_GT(point.joints.pan_rad, result.trace[i - 1].joints.pan_rad) << "a batch keeps order";
    }
  }
  EXPECT_EQ(result.trace.back().best_gain, result.view.gain);
}

}  // namespace
}  // namespace nbvopt::test
