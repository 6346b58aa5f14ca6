#include "server/request_handler.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "core/field_check.hpp"
#include "nbvopt/core/version.hpp"
#include "nbvopt/map/map_file.hpp"
#include "protocol/limit_error.hpp"
#include "protocol/map_messages.hpp"
#include "protocol/plan_messages.hpp"
#include "protocol/pose_messages.hpp"
#include "server/call_status.hpp"
#include "server/planner_by_gain.hpp"
#include "server/versions.hpp"

namespace nbvopt {
namespace {

using Clock = StopRule::Clock;

void stop_at_latest(StopRule& stop, Clock::time_point received, double limit_ms) {
  const auto deadline = *StopRule::within(limit_ms, received).deadline;
  stop.deadline = std::min(stop.deadline.value_or(deadline), deadline);
}

const std::string& needed_path(bool is_set, const std::string& path) {
  if (!is_set) throw InputError("path is not set");
  return path;
}

/// A client's text as a log may hold it: one short line, without quotes.
std::string log_text(std::string text) {
  constexpr std::size_t kMost = 200;
  text.resize(std::min(text.size(), kMost));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == '"' || c > '~'; },
      '?');
  return text;
}

void write_limits(const ServerLimits& limits, v1::GetStatusReply& reply) {
  const auto add = [&](const char* name, auto value) {
    v1::Limit& limit = *reply.add_limits();
    limit.set_name(name);
    limit.set_value(static_cast<double>(value));
  };
  add("max_message_mib", limits.max_message_mib);
  add("max_scan_points", limits.max_scan_points);
  add("max_views", limits.max_views);
  add("max_map_extent_m", limits.max_map_extent_m);
  add("min_resolution_m", limits.min_resolution_m);
  add("max_map_mib", limits.max_map_mib);
  add("max_compute_ms", limits.max_compute_ms);
  add("max_waiting", limits.max_waiting);
  add("max_streams", limits.max_streams);
  add("max_buffered_mib", limits.max_buffered_mib);
  add("max_receive_s", limits.max_receive_s);
  add("max_send_s", limits.max_send_s);
  add("max_pinned_mib", limits.max_pinned_mib);
  add("max_connections", limits.max_connections);
  add("max_web_connections", limits.max_web_connections);
}

}  // namespace

RequestHandler::RequestHandler(MapStore& store, const SnapshotKeeper* snapshots,
                               const DataFolder* data, const ServerLimits& limits)
    : store_(store), snapshots_(snapshots), data_(data), limits_(limits) {
  std::random_device random;
  run_id_ = std::uint64_t{random()} << 32 | random();
}

StopRule RequestHandler::limited(const StopRule& stop, Clock::time_point received) const {
  StopRule limited = stop;
  stop_at_latest(limited, received, limits_.max_compute_ms);
  return limited;
}

void RequestHandler::check_size(const google::protobuf::Message& message) const {
  constexpr std::uint64_t kMib = 1 << 20;
  const std::uint64_t bytes = message.ByteSizeLong();
  if (bytes <= static_cast<std::uint64_t>(limits_.max_message_mib) * kMib) return;
  throw LimitError("the message has " + std::to_string((bytes + kMib - 1) / kMib) +
                   " MiB, the limit is " + std::to_string(limits_.max_message_mib) +
                   " MiB (max_message_mib)");
}

std::shared_ptr<const ViewPlanner> RequestHandler::planner_by(const std::string* gain) const {
  if (gain == nullptr) return store_.published();
  return planner_by_gain(store_.published(), gain_from_text(*gain, "gain"));
}

v1::PlanReply RequestHandler::plan(const v1::PlanRequest& message, Clock::time_point received,
                                   const StopRule& stop) const {
  check_size(message);
  const auto planner = planner_by(message.has_gain() ? &message.gain() : nullptr);
  PlanRequest request = from_message(message);
  const std::unique_ptr<Solver> solver = make_solver(from_message(message.search()));
  request.stop.cancel = stop.cancel;
  request.stop.deadline = limited(stop, received).deadline;
  if (message.has_time_limit_ms()) {
    check_field(message.time_limit_ms() > 0.0, "time_limit_ms", message.time_limit_ms(),
                "positive and finite");
    const double limit_ms = std::min(message.time_limit_ms(), limits_.max_compute_ms);
    stop_at_latest(request.stop, received, limit_ms);
  }
  const auto result = std::make_shared<const PlanResult>(planner->plan(request, *solver));
  plans_.record(result, planner->robot().sensor.gain);
  v1::PlanReply reply = to_message(*result);
  reply.set_counting(to_string(planner->robot().sensor.counting));
  reply.set_gain(to_string(planner->robot().sensor.gain));
  if (message.has_request_id()) reply.set_request_id(message.request_id());
  return reply;
}

v1::EvaluateReply RequestHandler::evaluate(const v1::EvaluateRequest& message,
                                           Clock::time_point received, const StopRule& stop) const {
  check_size(message);
  if (message.views_size() > limits_.max_views) {
    throw LimitError("the call has " + std::to_string(message.views_size()) +
                     " views, the limit is " + std::to_string(limits_.max_views) + " (max_views)");
  }
  const auto planner = planner_by(message.has_gain() ? &message.gain() : nullptr);
  std::vector<Transform> poses_T_map_sensor;
  for (int i = 0; i < message.views_size(); ++i) {
    poses_T_map_sensor.push_back(
        from_message(message.views(i), planner->mast(), "views[" + std::to_string(i) + "]"));
  }
  // One thread: the other ones serve other calls.
  const std::vector<ViewGain> gains =
      planner->evaluate(poses_T_map_sensor, 1, limited(stop, received));

  v1::EvaluateReply reply;
  reply.set_map_version(planner->map_version());
  for (const ViewGain& gain : gains) {
    if (std::isnan(gain.gain)) {
      throw stop.cancel.is_cancelled()
          ? RequestError(grpc::StatusCode::CANCELLED, "cancelled before all views were evaluated")
          : RequestError(grpc::StatusCode::DEADLINE_EXCEEDED,
                         "out of time before all views were evaluated, ask for fewer at once");
    }
    *reply.add_gains() = to_message(gain);
  }
  return reply;
}

v1::InsertScanReply RequestHandler::insert_scan(const v1::InsertScanRequest& message,
                                                const CancelToken& cancel) {
  check_size(message);
  const Transform T_map_sensor = from_message(message.sensor(), "sensor");
  const Scan scan = scan_from_message(message, static_cast<std::uint64_t>(limits_.max_scan_points));
  const auto [result, version] = store_.insert(scan, T_map_sensor, cancel);
  scan_totals_.points_used += result.points_used;
  scan_totals_.points_ignored += result.points_ignored;
  scan_totals_.voxels_changed += result.changes.size();
  scan_totals_.information_gained += result.information_gained;
  v1::InsertScanReply reply;
  reply.set_map_version(version);
  reply.set_durable_version(durable_version());
  reply.set_run_id(run_id_);
  reply.set_points_used(result.points_used);
  reply.set_rays_cleared(result.rays_cleared);
  reply.set_points_ignored(result.points_ignored);
  reply.set_voxels_changed(result.changes.size());
  reply.set_information_gained(result.information_gained);
  reply.set_points_too_near(result.points_too_near);
  reply.set_points_too_far(result.points_too_far);
  reply.set_no_returns(result.no_returns);
  reply.set_points_not_finite(result.points_not_finite);
  reply.set_points_off_lattice(result.points_off_lattice);
  return reply;
}

v1::LoadMapReply RequestHandler::load_map(const v1::LoadMapRequest& message) {
  const std::string& path = needed_path(message.has_path(), message.path());
  const Descriptor file = data().open(path);
  std::ifstream in("/proc/self/fd/" + std::to_string(file.get()), std::ios::binary);
  UncertaintyMap map = read_map(in, "'" + path + "'");
  v1::LoadMapReply reply;
  reply.set_resolution_m(map.resolution_m());
  reply.set_map_version(store_.replace(std::move(map)));
  spdlog::info("event=map_loaded path=\"{}\" map_version={}", log_text(path), reply.map_version());
  return reply;
}

v1::SaveMapReply RequestHandler::save_map(const v1::SaveMapRequest& message) const {
  const std::string& path = needed_path(message.has_path(), message.path());
  const DataFolder& folder = data();
  const auto map = store_.bytes(from_message(message.format()));
  folder.write(path, map->bytes);
  v1::SaveMapReply reply;
  reply.set_map_version(map->version);
  reply.set_bytes(map->bytes.size());
  spdlog::info("event=map_saved path=\"{}\" map_version={}", log_text(path), map->version);
  return reply;
}

std::shared_ptr<const MapBytes> RequestHandler::get_map(const v1::GetMapRequest& message) const {
  const std::uint64_t pinned_mib = store_.pinned_bytes() >> 20;
  if (pinned_mib >= static_cast<std::uint64_t>(limits_.max_pinned_mib)) {
    throw RequestError(grpc::StatusCode::RESOURCE_EXHAUSTED,
                       "other clients still take " + std::to_string(pinned_mib) +
                           " MiB of older maps, the limit is " +
                           std::to_string(limits_.max_pinned_mib) +
                           " MiB (max_pinned_mib): ask again later");
  }
  return store_.bytes(from_message(message.format()));
}

v1::ClearMapReply RequestHandler::clear_map(const v1::ClearMapRequest& message) {
  v1::ClearMapReply reply;
  reply.set_map_version(store_.clear(
      message.has_resolution_m() ? std::optional(message.resolution_m()) : std::nullopt));
  spdlog::info("event=map_cleared map_version={}", reply.map_version());
  return reply;
}

v1::GetStatusReply RequestHandler::status(const v1::GetStatusRequest& message) const {
  v1::GetStatusReply reply;
  reply.set_version(version());
  reply.set_versions(server_version_report());
  reply.set_run_id(run_id_);
  const std::shared_ptr<const ViewPlanner> planner = store_.published();
  reply.set_map_version(planner->map_version());
  reply.set_resolution_m(planner->grid()->lattice().resolution_m());
  reply.set_map_bytes(store_.map_bytes());
  reply.set_map_copy_bytes(store_.copy_bytes());
  if (planner->robot().sensor.gain.has(GainKind::expected)) {
    const HazardTable hazards = planner->hazards();
    add_to(*reply.mutable_hazards(), hazards);
    reply.set_hazards_floor_m(hazards.floor_map_m());
  }
  plans_.write(reply);
  v1::ScanTotals& totals = *reply.mutable_scan_totals();
  totals.set_points_used(scan_totals_.points_used);
  totals.set_points_ignored(scan_totals_.points_ignored);
  totals.set_voxels_changed(scan_totals_.voxels_changed);
  totals.set_information_gained(scan_totals_.information_gained);
  write_limits(limits_, reply);
  if (snapshots_ != nullptr) {
    const SnapshotKeeper::State state = snapshots_->state();
    reply.set_durable_version(state.durable_version);
    reply.set_snapshot_error(state.error);
  }
  if (message.with_counts()) {
    const VersionedCounts counted = store_.counts();
    v1::MapCounts& counts = *reply.mutable_counts();
    counts.set_occupied_voxels(counted.counts.occupied_voxels);
    counts.set_free_voxels(counted.counts.free_voxels);
    counts.set_certain_voxels(counted.counts.certain_voxels);
    counts.set_information(counted.counts.information);
    counts.set_nodes(counted.counts.nodes);
    counts.set_paper_voxels(counted.paper.voxels);
    counts.set_paper_information(counted.paper.information);
    reply.set_counted_version(counted.version);
  }
  return reply;
}

std::uint64_t RequestHandler::durable_version() const {
  return snapshots_ == nullptr ? 0 : snapshots_->state().durable_version;
}

const DataFolder& RequestHandler::data() const {
  if (data_ != nullptr) return *data_;
  throw RequestError(grpc::StatusCode::FAILED_PRECONDITION,
                     "the server has no data folder, start it with one");
}

}  // namespace nbvopt
