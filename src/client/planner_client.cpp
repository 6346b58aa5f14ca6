#include "nbvopt/client/planner_client.hpp"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <limits>

#include "core/text_file.hpp"
#include "nbvopt/v1/planner.grpc.pb.h"
#include "protocol/map_messages.hpp"
#include "protocol/plan_messages.hpp"
#include "protocol/pose_messages.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

/// gRPC refuses a message that is too large with the code of a server that is busy.
bool is_too_large(const grpc::Status& status) {
  return status.error_message().find("larger than max") != std::string::npos;
}

ServerErrorKind kind_of(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return is_too_large(status) ? ServerErrorKind::bad_request : ServerErrorKind::busy;
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return ServerErrorKind::timeout;
    case grpc::StatusCode::CANCELLED:
      return ServerErrorKind::cancelled;
    case grpc::StatusCode::UNAVAILABLE:
      return ServerErrorKind::unavailable;
    case grpc::StatusCode::DATA_LOSS:
      return ServerErrorKind::not_saved;
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::UNKNOWN:
      return ServerErrorKind::internal;
    default:
      return ServerErrorKind::bad_request;
  }
}

std::shared_ptr<grpc::ChannelCredentials> credentials(const ClientTls& tls) {
  if (tls.server_ca.empty() && tls.certificate.empty() && tls.key.empty()) {
    return grpc::InsecureChannelCredentials();
  }
  return grpc::SslCredentials({.pem_root_certs = read_text_file(tls.server_ca),
                               .pem_private_key = read_text_file(tls.key),
                               .pem_cert_chain = read_text_file(tls.certificate)});
}

/// Whole maps are larger than gRPC's default.
std::shared_ptr<grpc::Channel> channel(const std::string& address, const ClientTls& tls) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  return grpc::CreateCustomChannel(address, credentials(tls), arguments);
}

MapCounts from_message(const v1::MapCounts& counts) {
  MapCounts own;
  own.occupied_voxels = counts.occupied_voxels();
  own.free_voxels = counts.free_voxels();
  own.certain_voxels = counts.certain_voxels();
  own.information = counts.information();
  own.nodes = counts.nodes();
  return own;
}

}  // namespace

struct PlannerClient::Connection {
  Connection(const std::string& server, const ClientTls& tls, std::chrono::milliseconds longest)
      : address(server), timeout(longest), stub(v1::Planner::NewStub(channel(server, tls))) {}

  void set_deadline(grpc::ClientContext& context) const {
    context.set_deadline(std::chrono::system_clock::now() + timeout);
  }

  void check(const grpc::Status& status) const {
    if (status.ok()) return;
    const std::string reason = status.error_code() == grpc::StatusCode::UNAVAILABLE
                                   ? "no server answers there (" + status.error_message() + ")"
                                   : status.error_message();
    const std::string remedy = is_too_large(status) ? ": the server's max_message_mib" : "";
    throw ServerError(kind_of(status), address + ": " + reason + remedy);
  }

  /// One unary call.
  template <typename Request, typename Reply>
  Reply call(grpc::Status (v1::Planner::Stub::*method)(grpc::ClientContext*, const Request&,
                                                       Reply*),
             const Request& request) const {
    grpc::ClientContext context;
    set_deadline(context);
    Reply reply;
    check(((*stub).*method)(&context, request, &reply));
    return reply;
  }

  std::string address;
  std::chrono::milliseconds timeout;
  std::unique_ptr<v1::Planner::Stub> stub;
};

PlannerClient::PlannerClient(const std::string& address, const ClientTls& tls,
                             std::chrono::milliseconds timeout)
    : connection_(std::make_unique<Connection>(address, tls, timeout)) {}
PlannerClient::PlannerClient(PlannerClient&&) noexcept = default;
PlannerClient::~PlannerClient() = default;

RemotePlan PlannerClient::plan(const PlanRequest& request, const Search& search,
                               const std::optional<GainChoice>& gain) {
  v1::PlanRequest message = to_message(request);
  if (gain) message.set_gain(to_string(*gain));
  *message.mutable_search() = to_message(search);
  if (request.stop.deadline) {
    const std::chrono::duration<double, std::milli> left =
        *request.stop.deadline - StopRule::Clock::now();
    message.set_time_limit_ms(std::max(left.count(), std::numeric_limits<double>::min()));
  }
  const v1::PlanReply reply = connection_->call(&v1::Planner::Stub::Plan, message);
  RemotePlan plan;
  plan.result = from_message(reply);
  // Servers before this field have the robot's alone, and do not tell it.
  if (!reply.gain().empty()) plan.gain = gain_from_text(reply.gain(), "the answer's gain");
  plan.result.request = request;
  plan.counting = enum_value<Counting>(reply.counting()).value_or(Counting::per_ray);
  return plan;
}

RemoteGains PlannerClient::evaluate(std::span<const Transform> poses_T_map_sensor,
                                    const std::optional<GainChoice>& gain) {
  v1::EvaluateRequest message;
  if (gain) message.set_gain(to_string(*gain));
  for (const Transform& pose : poses_T_map_sensor) {
    *message.add_views()->mutable_sensor() = to_message(pose);
  }
  const v1::EvaluateReply reply = connection_->call(&v1::Planner::Stub::Evaluate, message);
  RemoteGains gains{.gains = {}, .map_version = reply.map_version()};
  for (const v1::ViewGain& view : reply.gains()) gains.gains.push_back(from_message(view));
  return gains;
}

ScanReceipt PlannerClient::insert_scan(const Scan& scan, const Transform& T_map_sensor) {
  v1::InsertScanRequest message;
  *message.mutable_sensor() = to_message(T_map_sensor);
  *message.mutable_points() = to_message(scan);
  const v1::InsertScanReply reply = connection_->call(&v1::Planner::Stub::InsertScan, message);
  return {.map_version = reply.map_version(),
          .durable_version = reply.durable_version(),
          .run_id = reply.run_id(),
          .points_used = reply.points_used(),
          .rays_cleared = reply.rays_cleared(),
          .points_ignored = reply.points_ignored(),
          .voxels_changed = reply.voxels_changed(),
          .information_gained = reply.information_gained(),
          .points_too_near = reply.points_too_near(),
          .points_too_far = reply.points_too_far(),
          .no_returns = reply.no_returns(),
          .points_not_finite = reply.points_not_finite(),
          .points_off_lattice = reply.points_off_lattice()};
}

std::uint64_t PlannerClient::load_map(const std::string& path) {
  v1::LoadMapRequest message;
  message.set_path(path);
  return connection_->call(&v1::Planner::Stub::LoadMap, message).map_version();
}

std::uint64_t PlannerClient::save_map(const std::string& path, MapFormat format) {
  v1::SaveMapRequest message;
  message.set_path(path);
  message.set_format(to_message(format));
  return connection_->call(&v1::Planner::Stub::SaveMap, message).map_version();
}

RemoteMap PlannerClient::get_map(MapFormat format) {
  grpc::ClientContext context;
  connection_->set_deadline(context);
  v1::GetMapRequest message;
  message.set_format(to_message(format));
  const auto reader = connection_->stub->GetMap(&context, message);
  RemoteMap map;
  v1::MapChunk chunk;
  while (reader->Read(&chunk)) {
    map.bytes += chunk.data();
    map.map_version = chunk.map_version();
  }
  connection_->check(reader->Finish());
  return map;
}

std::uint64_t PlannerClient::clear_map(std::optional<double> resolution_m) {
  v1::ClearMapRequest message;
  if (resolution_m) message.set_resolution_m(*resolution_m);
  return connection_->call(&v1::Planner::Stub::ClearMap, message).map_version();
}

ServerStatus PlannerClient::status(bool with_counts) {
  v1::GetStatusRequest message;
  message.set_with_counts(with_counts);
  const v1::GetStatusReply reply = connection_->call(&v1::Planner::Stub::GetStatus, message);
  return {.version = reply.version(),
          .versions = reply.versions(),
          .uptime_s = reply.uptime_s(),
          .map_version = reply.map_version(),
          .durable_version = reply.durable_version(),
          .run_id = reply.run_id(),
          .snapshot_error = reply.snapshot_error(),
          .resolution_m = reply.resolution_m(),
          .scans = reply.scans(),
          .connections = reply.connections(),
          .connections_refused = reply.connections_refused(),
          .connections_silent = reply.connections_silent(),
          .counts = from_message(reply.counts()),
          .paper_counts = {.voxels = reply.counts().paper_voxels(),
                           .information = reply.counts().paper_information()},
          .hazards = from_message(reply.hazards(), reply.hazards_floor_m())};
}

}  // namespace nbvopt
