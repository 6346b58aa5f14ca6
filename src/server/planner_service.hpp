// The gRPC service: each call becomes a piece of work on one of three queues.
//
// gRPC's own threads only move messages. Plans and evaluations share threads of their own; all that
// changes the map is done by one thread, in order; what waits for the disk or copies a whole map by
// another, so that neither keeps plans or scans waiting; and the status is told whatever else goes
// on. A full queue sheds the call.
#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/service_type.h>

#include <array>
#include <chrono>
#include <string>

#include "server/call_log.hpp"
#include "server/connection_log.hpp"
#include "server/limits.hpp"
#include "server/receive_watch.hpp"
#include "server/request_handler.hpp"
#include "server/work_queue.hpp"

namespace nbvopt {

/// Registers its methods itself, as protoc's service class does: that one would have gRPC read the
/// messages of unary calls (see UnaryCall).
class PlannerService final : public grpc::Service {
 public:
  /// Plans on `planning_threads`. Handler and log must outlive the service, and the service the
  /// server.
  PlannerService(RequestHandler& handler, const ConnectionLog& connections,
                 std::size_t planning_threads);

  /// What GetStatus answers.
  v1::GetStatusReply status(const v1::GetStatusRequest& request) const;

 private:
  void add(Method method, grpc::internal::RpcMethod::RpcType type,
           grpc::internal::MethodHandler* handler);

  /// A method of one message and one reply, which `run(request, limits)` makes on the queue that
  /// `queue_of(request)` chooses.
  template <typename Request, typename Reply, typename QueueOf, typename Run>
  void add_unary(Method method, QueueOf queue_of, Run run);

  /// A method of two streams; `start(context)` makes the reactor.
  template <typename Request, typename Reply, typename Start>
  void add_streams(Method method, Start start);

  void add_planning();
  void add_mapping();
  void add_storage();
  void add_status();

  RequestHandler& handler_;
  const ConnectionLog& connections_;
  CallLog log_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  OpenStreams streams_;
  ReceiveWatch watch_;
  ReceiveWatch sending_;  ///< of maps, to clients that receive them
  MessageMemory memory_;
  WorkQueue planning_;
  WorkQueue mapping_;
  WorkQueue storage_;
  WorkQueue status_;
  std::array<std::string, kMethodCount> paths_;  ///< gRPC keeps pointers to them
  int methods_ = 0;
};

}  // namespace nbvopt
