#include "server/call_log.hpp"

namespace nbvopt {
namespace {

constexpr std::array kMethodNames{"Plan",    "PlanStream", "Evaluate", "InsertScan", "InsertScans",
                                  "LoadMap", "SaveMap",    "GetMap",   "ClearMap",   "GetStatus"};

static_assert(kMethodNames.size() == kMethodCount);

constexpr std::array kCodeNames{
    "OK",        "CANCELLED",      "UNKNOWN",           "INVALID_ARGUMENT",   "DEADLINE_EXCEEDED",
    "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED", "FAILED_PRECONDITION",
    "ABORTED",   "OUT_OF_RANGE",   "UNIMPLEMENTED",     "INTERNAL",           "UNAVAILABLE",
    "DATA_LOSS", "UNAUTHENTICATED"};
static_assert(kCodeNames.size() == kStatusCodes);

}  // namespace

const char* name_of(Method method) { return kMethodNames.at(static_cast<std::size_t>(method)); }

void CallLog::write(v1::GetStatusReply& reply) const {
  for (std::size_t i = 0; i < kMethodCount; ++i) {
    const LatencyHistogram::Counts counts = entries_[i].latency.counts();
    v1::Latency& latency = *reply.add_latencies();
    latency.set_method(kMethodNames[i]);
    latency.set_calls(counts.calls);
    std::uint64_t failed = 0;
    for (std::size_t code = 0; code < kStatusCodes; ++code) {
      const std::uint64_t calls = entries_[i].failed[code];
      if (calls == 0) continue;
      failed += calls;
      v1::FailureCount& failure = *latency.add_failures();
      failure.set_code(kCodeNames[code]);
      failure.set_calls(calls);
    }
    latency.set_failed(failed);
    latency.set_shed(entries_[i].shed);
    latency.set_sum_ms(counts.sum_ms);
    latency.set_max_ms(counts.max_ms);
    for (const double bound_ms : LatencyHistogram::upper_bounds_ms()) {
      latency.add_upper_bounds_ms(bound_ms);
    }
    for (const std::uint64_t count : counts.buckets) latency.add_counts(count);
  }
  const auto scans = [this](Method method) {
    return entries_[static_cast<std::size_t>(method)].latency.counts().calls;
  };
  reply.set_scans(scans(Method::insert_scan) + scans(Method::insert_scans));
}

}  // namespace nbvopt
