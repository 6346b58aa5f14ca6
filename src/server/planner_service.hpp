// The gRPC service: each call becomes a piece of work on one of three queues.
//
// gRPC's own threads only move messages. Plans and evaluations share threads of their own; all that
// changes the map is done by one thread, in order; what waits for the disk or copies a whole map by
// another, so that neither keeps plans or scans waiting; and the status is told whatever else goes
// on. A full queue sheds the call.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>

#include "nbvopt/v1/planner.grpc.pb.h"
#include "server/call_log.hpp"
#include "server/connection_log.hpp"
#include "server/limits.hpp"
#include "server/request_handler.hpp"
#include "server/work_queue.hpp"

namespace nbvopt {

class PlannerService final : public v1::Planner::CallbackService {
 public:
  /// Plans on `planning_threads`. Handler and log must outlive the service, and the service the
  /// server.
  PlannerService(RequestHandler& handler, const ConnectionLog& connections,
                 std::size_t planning_threads);

  grpc::ServerUnaryReactor* Plan(grpc::CallbackServerContext* context,
                                 const v1::PlanRequest* request, v1::PlanReply* reply) override;
  grpc::ServerBidiReactor<v1::PlanRequest, v1::PlanReply>* PlanStream(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* Evaluate(grpc::CallbackServerContext* context,
                                     const v1::EvaluateRequest* request,
                                     v1::EvaluateReply* reply) override;
  grpc::ServerUnaryReactor* InsertScan(grpc::CallbackServerContext* context,
                                       const v1::InsertScanRequest* request,
                                       v1::InsertScanReply* reply) override;
  grpc::ServerBidiReactor<v1::InsertScanRequest, v1::InsertScanReply>* InsertScans(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* LoadMap(grpc::CallbackServerContext* context,
                                    const v1::LoadMapRequest* request,
                                    v1::LoadMapReply* reply) override;
  grpc::ServerUnaryReactor* SaveMap(grpc::CallbackServerContext* context,
                                    const v1::SaveMapRequest* request,
                                    v1::SaveMapReply* reply) override;
  grpc::ServerWriteReactor<v1::MapChunk>* GetMap(grpc::CallbackServerContext* context,
                                                 const v1::GetMapRequest* request) override;
  grpc::ServerUnaryReactor* ClearMap(grpc::CallbackServerContext* context,
                                     const v1::ClearMapRequest* request,
                                     v1::ClearMapReply* reply) override;
  grpc::ServerUnaryReactor* GetStatus(grpc::CallbackServerContext* context,
                                      const v1::GetStatusRequest* request,
                                      v1::GetStatusReply* reply) override;

 private:
  RequestHandler& handler_;
  const ConnectionLog& connections_;
  CallLog log_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  OpenStreams streams_;
  WorkQueue planning_;
  WorkQueue mapping_;
  WorkQueue storage_;
  WorkQueue status_;
};

}  // namespace nbvopt
