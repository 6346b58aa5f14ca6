#include "server/planner_service.hpp"

#include <utility>

#include "nbvopt/v1/planner.grpc.pb.h"
#include "server/map_stream.hpp"
#include "server/plan_stream.hpp"
#include "server/scan_stream.hpp"
#include "server/unary_call.hpp"

namespace nbvopt {
namespace {

using grpc::CallbackServerContext;
using grpc::internal::RpcMethod;

/// The queue of all calls of a method.
auto always(WorkQueue& queue) {
  return [&queue](const auto&) -> WorkQueue& { return queue; };
}

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1e3));
}

}  // namespace

PlannerService::PlannerService(RequestHandler& handler, const ConnectionLog& connections,
                               std::size_t planning_threads)
    : handler_(handler),
      connections_(connections),
      streams_(handler.limits().max_streams),
      watch_(milliseconds(handler.limits().max_receive_s)),
      sending_(milliseconds(handler.limits().max_send_s)),
      memory_(handler.limits().max_buffered_mib),
      planning_(planning_threads, static_cast<std::size_t>(handler.limits().max_waiting)),
      mapping_(1, static_cast<std::size_t>(handler.limits().max_waiting)),
      storage_(1, static_cast<std::size_t>(handler.limits().max_waiting)),
      status_(1, static_cast<std::size_t>(handler.limits().max_waiting)) {
  add_planning();
  add_mapping();
  add_storage();
  add_status();
}

void PlannerService::add(Method method, RpcMethod::RpcType type,
                         grpc::internal::MethodHandler* handler) {
  std::string& path = paths_.at(static_cast<std::size_t>(method));
  path = std::string("/") + v1::Planner::service_full_name() + "/" + name_of(method);
  AddMethod(new grpc::internal::RpcServiceMethod(path.c_str(), type, nullptr));
  MarkMethodCallback(methods_++, handler);
}

template <typename Request, typename Reply, typename Start>
void PlannerService::add_streams(Method method, Start start) {
  add(method, RpcMethod::BIDI_STREAMING,
      new grpc::internal::CallbackBidiHandler<Request, Reply>(std::move(start)));
}

template <typename Request, typename Reply, typename QueueOf, typename Run>
void PlannerService::add_unary(Method method, QueueOf queue_of, Run run) {
  add_streams<Request, Reply>(method, [=, this](CallbackServerContext* context) {
    return new UnaryCall<Request, Reply, QueueOf, Run>(
        *context, UnaryCallParts{log_, watch_, memory_}, method, queue_of, run);
  });
}

void PlannerService::add_planning() {
  add_unary<v1::PlanRequest, v1::PlanReply>(
      Method::plan, always(planning_), [this](const auto& request, const CallLimits& limits) {
        return handler_.plan(request, limits.received(), limits.stop());
      });
  add_streams<v1::PlanRequest, v1::PlanReply>(
      Method::plan_stream, [this](CallbackServerContext* context) {
        return new PlanStreamCall(*context, handler_, log_, planning_, streams_, memory_);
      });
  add_unary<v1::EvaluateRequest, v1::EvaluateReply>(
      Method::evaluate, always(planning_), [this](const auto& request, const CallLimits& limits) {
        return handler_.evaluate(request, limits.received(), limits.stop());
      });
}

void PlannerService::add_mapping() {
  add_unary<v1::InsertScanRequest, v1::InsertScanReply>(
      Method::insert_scan, always(mapping_), [this](const auto& request, const CallLimits& limits) {
        return handler_.insert_scan(request, limits.stop().cancel);
      });
  add_streams<v1::InsertScanRequest, v1::InsertScanReply>(
      Method::insert_scans, [this](CallbackServerContext* context) {
        return new ScanStreamCall(*context, handler_, log_, mapping_, streams_, memory_);
      });
  add_unary<v1::ClearMapRequest, v1::ClearMapReply>(
      Method::clear_map, always(mapping_),
      [this](const auto& request, const CallLimits&) { return handler_.clear_map(request); });
}

void PlannerService::add_storage() {
  add_unary<v1::LoadMapRequest, v1::LoadMapReply>(
      Method::load_map, always(storage_),
      [this](const auto& request, const CallLimits&) { return handler_.load_map(request); });
  add_unary<v1::SaveMapRequest, v1::SaveMapReply>(
      Method::save_map, always(storage_),
      [this](const auto& request, const CallLimits&) { return handler_.save_map(request); });
  add(Method::get_map, RpcMethod::SERVER_STREAMING,
      new grpc::internal::CallbackServerStreamingHandler<v1::GetMapRequest, v1::MapChunk>(
          [this](CallbackServerContext* context, const v1::GetMapRequest* request) {
            return new MapStreamCall(*context, *request, handler_, log_, storage_, streams_,
                                     sending_);
          }));
}

void PlannerService::add_status() {
  const auto queue_of = [this](const v1::GetStatusRequest& request) -> WorkQueue& {
    return request.with_counts() ? storage_ : status_;
  };
  add_unary<v1::GetStatusRequest, v1::GetStatusReply>(
      Method::get_status, queue_of,
      [this](const auto& request, const CallLimits&) { return status(request); });
}

v1::GetStatusReply PlannerService::status(const v1::GetStatusRequest& request) const {
  v1::GetStatusReply reply = handler_.status(request);
  const std::chrono::duration<double> uptime = std::chrono::steady_clock::now() - start_;
  reply.set_uptime_s(uptime.count());
  log_.write(reply);
  connections_.write(reply);
  reply.set_streams(static_cast<std::uint64_t>(streams_.open()));
  reply.set_message_bytes(memory_.taken_bytes());
  return reply;
}

}  // namespace nbvopt
