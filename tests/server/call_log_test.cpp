#include "server/call_log.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace nbvopt {
namespace {

TEST(LatencyHistogram, PutsEachCallInItsBucket) {
  LatencyHistogram histogram;
  const auto& bounds_ms = LatencyHistogram::upper_bounds_ms();
  histogram.record(0.0);
  histogram.record(bounds_ms[3]);  // a bound belongs to its bucket
  histogram.record(bounds_ms[3] * 1.01);
  histogram.record(1e9);
  const LatencyHistogram::Counts counts = histogram.counts();
  EXPECT_EQ(counts.buckets[0], 1U);
  EXPECT_EQ(counts.buckets[3], 1U);
  EXPECT_EQ(counts.buckets[4], 1U);
  EXPECT_EQ(counts.buckets[LatencyHistogram::kBounds], 1U);
  EXPECT_EQ(counts.calls, 4U);
  EXPECT_EQ(counts.max_ms, 1e9);
  EXPECT_DOUBLE_EQ(counts.sum_ms, 2.01 * bounds_ms[3] + 1e9);
}

TEST(LatencyHistogram, BoundsGrowFromTwentiethsOfAMillisecondToHalfAMinute) {
  const auto& bounds_ms = LatencyHistogram::upper_bounds_ms();
  EXPECT_EQ(bounds_ms.front(), 0.05);
  EXPECT_GT(bounds_ms.back(), 20e3);
  for (std::size_t i = 1; i < bounds_ms.size(); ++i) {
    EXPECT_NEAR(bounds_ms[i] / bounds_ms[i - 1], 1.189, 1e-3);
  }
}

TEST(CallLog, TellsOfEveryMethod) {
  CallLog log;
  log.record_answer(Method::insert_scan, 2.0);
  log.record_answer(Method::insert_scans, 3.0);
  log.record_failure(Method::plan, grpc::StatusCode::OUT_OF_RANGE);
  log.record_shed(Method::get_status);
  v1::GetStatusReply reply;
  log.write(reply);
  EXPECT_EQ(reply.scans(), 2U);
  ASSERT_EQ(reply.latencies_size(), 10);
  EXPECT_EQ(reply.latencies(0).method(), "Plan");
  EXPECT_EQ(reply.latencies(0).failed(), 1U);
  ASSERT_EQ(reply.latencies(0).failures_size(), 1);
  EXPECT_EQ(reply.latencies(0).failures(0).code(), "OUT_OF_RANGE");
  EXPECT_EQ(reply.latencies(0).failures(0).calls(), 1U);
  EXPECT_EQ(reply.latencies(9).method(), "GetStatus");
  EXPECT_EQ(reply.latencies(9).shed(), 1U);
  const v1::Latency& scans = reply.latencies(3);
  EXPECT_EQ(scans.method(), "InsertScan");
  EXPECT_EQ(scans.max_ms(), 2.0);
  EXPECT_EQ(scans.counts_size(), scans.upper_bounds_ms_size() + 1);
  EXPECT_EQ(std::accumulate(scans.counts().begin(), scans.counts().end(), 0UL), 1UL);
}

}  // namespace
}  // namespace nbvopt
