// How calls went: latencies, errors and what was shed, by method.
#pragma once

#include <grpcpp/support/status_code_enum.h>

#include <array>
#include <atomic>
#include <cstddef>

#include "nbvopt/v1/planner.pb.h"
#include "server/latency_histogram.hpp"

namespace nbvopt {

enum class Method {
  plan,
  plan_stream,  ///< each plan of a stream is a call
  evaluate,
  insert_scan,
  insert_scans,  ///< each scan of a stream is a call
  load_map,
  save_map,
  get_map,
  clear_map,
  get_status,
};

constexpr std::size_t kMethodCount = 10;
constexpr std::size_t kStatusCodes = grpc::StatusCode::UNAUTHENTICATED + 1;

/// As in planner.proto.
const char* name_of(Method method);

/// Safe to share between threads.
class CallLog {
 public:
  void record_answer(Method method, double elapsed_ms) { of(method).latency.record(elapsed_ms); }
  void record_failure(Method method, grpc::StatusCode code) {
    ++of(method).failed.at(static_cast<std::size_t>(code));
  }
  void record_shed(Method method) { ++of(method).shed; }

  /// Adds the figures of all methods.
  void write(v1::GetStatusReply& reply) const;

 private:
  struct Entry {
    LatencyHistogram latency;
    std::array<std::atomic<std::uint64_t>, kStatusCodes> failed{};  ///< by grpc::StatusCode
    std::atomic<std::uint64_t> shed{0};
  };
  Entry& of(Method method) { return entries_[static_cast<std::size_t>(method)]; }

  std::array<Entry, kMethodCount> entries_;
};

}  // namespace nbvopt
