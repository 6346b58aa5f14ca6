#include "server/web/metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/call_log.hpp"
#include "server/plan_log.hpp"

namespace nbvopt {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Metrics, AreWhatTheStatusTells) {
  CallLog calls;
  calls.record_answer(Method::plan, 0.07);
  calls.record_answer(Method::plan, 3.0);
  calls.record_answer(Method::plan, 1e6);
  calls.record_failure(Method::plan, grpc::StatusCode::OUT_OF_RANGE);
  calls.record_shed(Method::insert_scan);
  PlanLog plans;
  PlanResult plan;
  plan.status = PlanStatus::time_limit;
  plans.record(std::make_shared<const PlanResult>(plan), GainKind::positive);
  v1::GetStatusReply status;
  status.set_version("1.2\"\n}");  // nothing ends its line or its quotes
  status.set_map_version(7);
  status.set_snapshot_error("the disk is full");
  calls.write(status);
  plans.write(status);
  WebLog web;
  web.forbidden = 4;
  const std::string text = metrics_text(status, web);
  for (const char* line :
       {"nbvopt_build_info{version=\"1.2\\\"\\n}\"} 1\n", "nbvopt_map_version 7\n",
        "nbvopt_snapshot_failed 1\n", "# TYPE nbvopt_call_duration_seconds histogram\n",
        "nbvopt_call_duration_seconds_bucket{method=\"Plan\",le=\"5e-05\"} 0\n",
        "nbvopt_call_duration_seconds_bucket{method=\"Plan\",le=\"0.0001\"} 1\n",
        "nbvopt_call_duration_seconds_bucket{method=\"Plan\",le=\"26.2144\"} 2\n",
        "nbvopt_call_duration_seconds_bucket{method=\"Plan\",le=\"+Inf\"} 3\n",
        "nbvopt_call_duration_seconds_count{method=\"Plan\"} 3\n",
        "nbvopt_calls_failed_total{method=\"Plan\",code=\"OUT_OF_RANGE\"} 1\n",
        "nbvopt_calls_shed_total{method=\"InsertScan\"} 1\n",
        "nbvopt_calls_shed_total{method=\"Plan\"} 0\n",
        "nbvopt_plans_total{status=\"time_limit\"} 1\n",
        "nbvopt_plans_total{status=\"cancelled\"} 0\n", "nbvopt_web_forbidden_total 4\n"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
  EXPECT_THAT(text, Not(HasSubstr("hazard")));  // the gain is not expected
}

}  // namespace
}  // namespace nbvopt
