#include "server/planner_service.hpp"

#include "server/map_stream.hpp"
#include "server/plan_stream.hpp"
#include "server/queued_call.hpp"
#include "server/scan_stream.hpp"

namespace nbvopt {

using grpc::CallbackServerContext;
using grpc::ServerUnaryReactor;

PlannerService::PlannerService(RequestHandler& handler, const ConnectionLog& connections,
                               std::size_t planning_threads)
    : handler_(handler),
      connections_(connections),
      streams_(handler.limits().max_streams),
      planning_(planning_threads, static_cast<std::size_t>(handler.limits().max_waiting)),
      mapping_(1, static_cast<std::size_t>(handler.limits().max_waiting)),
      storage_(1, static_cast<std::size_t>(handler.limits().max_waiting)),
      status_(1, static_cast<std::size_t>(handler.limits().max_waiting)) {}

ServerUnaryReactor* PlannerService::Plan(CallbackServerContext* context,
                                         const v1::PlanRequest* request, v1::PlanReply* reply) {
  return start_call(*context, log_, Method::plan, planning_, [=, this](const CallLimits& limits) {
    *reply = handler_.plan(*request, limits.received(), limits.stop());
  });
}

grpc::ServerBidiReactor<v1::PlanRequest, v1::PlanReply>* PlannerService::PlanStream(
    CallbackServerContext* context) {
  return new PlanStreamCall(*context, handler_, log_, planning_, streams_);
}

ServerUnaryReactor* PlannerService::Evaluate(CallbackServerContext* context,
                                             const v1::EvaluateRequest* request,
                                             v1::EvaluateReply* reply) {
  return start_call(*context, log_, Method::evaluate, planning_,
                    [=, this](const CallLimits& limits) {
                      *reply = handler_.evaluate(*request, limits.received(), limits.stop());
                    });
}

ServerUnaryReactor* PlannerService::InsertScan(CallbackServerContext* context,
                                               const v1::InsertScanRequest* request,
                                               v1::InsertScanReply* reply) {
  return start_call(*context, log_, Method::insert_scan, mapping_,
                    [=, this](const CallLimits&) { *reply = handler_.insert_scan(*request); });
}

grpc::ServerBidiReactor<v1::InsertScanRequest, v1::InsertScanReply>* PlannerService::InsertScans(
    CallbackServerContext*) {
  return new ScanStreamCall(handler_, log_, mapping_, streams_);
}

ServerUnaryReactor* PlannerService::LoadMap(CallbackServerContext* context,
                                            const v1::LoadMapRequest* request,
                                            v1::LoadMapReply* reply) {
  return start_call(*context, log_, Method::load_map, storage_,
                    [=, this](const CallLimits&) { *reply = handler_.load_map(*request); });
}

ServerUnaryReactor* PlannerService::SaveMap(CallbackServerContext* context,
                                            const v1::SaveMapRequest* request,
                                            v1::SaveMapReply* reply) {
  return start_call(*context, log_, Method::save_map, storage_,
                    [=, this](const CallLimits&) { *reply = handler_.save_map(*request); });
}

grpc::ServerWriteReactor<v1::MapChunk>* PlannerService::GetMap(CallbackServerContext*,
                                                               const v1::GetMapRequest* request) {
  return new MapStreamCall(*request, handler_, log_, storage_, streams_);
}

ServerUnaryReactor* PlannerService::ClearMap(CallbackServerContext* context,
                                             const v1::ClearMapRequest* request,
                                             v1::ClearMapReply* reply) {
  return start_call(*context, log_, Method::clear_map, mapping_,
                    [=, this](const CallLimits&) { *reply = handler_.clear_map(*request); });
}

ServerUnaryReactor* PlannerService::GetStatus(CallbackServerContext* context,
                                              const v1::GetStatusRequest* request,
                                              v1::GetStatusReply* reply) {
  return start_call(*context, log_, Method::get_status, request->with_counts() ? storage_ : status_,
                    [=, this](const CallLimits&) {
                      *reply = handler_.status(*request);
                      const std::chrono::duration<double> uptime =
                          std::chrono::steady_clock::now() - start_;
                      reply->set_uptime_s(uptime.count());
                      log_.write(*reply);
                      connections_.write(*reply);
                    });
}

}  // namespace nbvopt
