// What the server does with each request, without the network: a message in, a message out.
#pragma once

#include <atomic>

#include "nbvopt/core/stop.hpp"
#include "nbvopt/v1/planner.pb.h"
#include "server/data_folder.hpp"
#include "server/map_store.hpp"
#include "server/plan_log.hpp"
#include "server/snapshot_keeper.hpp"

namespace nbvopt {

/// Safe to share between threads. All throw InputError or UsageError for a request that cannot be
/// used, LimitError for one beyond a limit, and RequestError for the rest.
class RequestHandler {
 public:
  /// `snapshots` and `data` are null when the server was started without. All must outlive this.
  RequestHandler(MapStore& store, const SnapshotKeeper* snapshots, const DataFolder* data,
                 const ServerLimits& limits);

  const ServerLimits& limits() const { return limits_; }

  /// `received`: the request's own time limit counts from then. `stop` holds the call's deadline
  /// and its cancellation.
  v1::PlanReply plan(const v1::PlanRequest& message, StopRule::Clock::time_point received,
                     const StopRule& stop) const;

  /// Throws RequestError (DEADLINE_EXCEEDED or CANCELLED) when `stop` comes before the last view.
  v1::EvaluateReply evaluate(const v1::EvaluateRequest& message,
                             StopRule::Clock::time_point received, const StopRule& stop) const;

  /// Throws CancelledError, the map then untouched.
  v1::InsertScanReply insert_scan(const v1::InsertScanRequest& message,
                                  const CancelToken& cancel = CancelToken());
  v1::LoadMapReply load_map(const v1::LoadMapRequest& message);
  v1::SaveMapReply save_map(const v1::SaveMapRequest& message) const;
  /// Throws RequestError (RESOURCE_EXHAUSTED) while others hold too much of older maps.
  std::shared_ptr<const MapBytes> get_map(const v1::GetMapRequest& message) const;
  v1::ClearMapReply clear_map(const v1::ClearMapRequest& message);

  /// All but the service's own figures.
  v1::GetStatusReply status(const v1::GetStatusRequest& message) const;

  const PlanLog& plans() const { return plans_; }
  std::uint64_t durable_version() const;
  /// Tells this run of the server from all others.
  std::uint64_t run_id() const { return run_id_; }

 private:
  /// Of all scans since the server started.
  struct ScanTotals {
    std::atomic<std::uint64_t> points_used{0};
    std::atomic<std::uint64_t> points_ignored{0};
    std::atomic<std::uint64_t> voxels_changed{0};
    std::atomic<double> information_gained{0.0};
  };

  /// The stop rule with the server's own limit of computing.
  StopRule limited(const StopRule& stop, StopRule::Clock::time_point received) const;
  /// On the newest version of the map, by the gain of that name; null: the robot's.
  std::shared_ptr<const ViewPlanner> planner_by(const std::string* gain) const;
  /// Throws LimitError when a message is too large.
  void check_size(const google::protobuf::Message& message) const;
  /// Throws RequestError when there is none.
  const DataFolder& data() const;

  MapStore& store_;
  const SnapshotKeeper* snapshots_;
  const DataFolder* data_;
  ServerLimits limits_;
  std::uint64_t run_id_;
  mutable PlanLog plans_;
  ScanTotals scan_totals_;
};

}  // namespace nbvopt
