// InsertScans: a client's stream of scans, inserted one after the other.
#pragma once

#include "nbvopt/v1/planner.pb.h"
#include "server/queued_call.hpp"
#include "server/request_handler.hpp"

namespace nbvopt {

/// Deletes itself when the stream has ended. The next scan is read when the last one is inserted,
/// so that a fast client waits instead of filling the server's memory.
class ScanStreamCall final : public grpc::ServerReadReactor<v1::InsertScanRequest> {
 public:
  ScanStreamCall(v1::InsertScansReply& reply, RequestHandler& handler, CallLog& log,
                 WorkQueue& queue)
      : reply_(reply), handler_(handler), log_(log), queue_(queue) {
    StartRead(&scan_);
  }

 private:
  void OnReadDone(bool ok) override {
    if (!ok) return Finish(grpc::Status::OK);  // all are read, or the client is gone
    received_ = StopRule::Clock::now();
    if (queue_.try_post([this] { insert(); })) return;
    log_.record_shed(Method::insert_scans);
    Finish(shed_status());
  }

  void insert() {
    const grpc::Status status = logged(log_, Method::insert_scans, received_, [this] {
      const v1::InsertScanReply inserted = handler_.insert_scan(scan_);
      reply_.set_scans(reply_.scans() + 1);
      reply_.set_map_version(inserted.map_version());
      reply_.set_durable_version(inserted.durable_version());
    });
    if (!status.ok()) return Finish(status);
    StartRead(&scan_);
  }

  void OnDone() override { delete this; }

  v1::InsertScansReply& reply_;
  RequestHandler& handler_;
  CallLog& log_;
  WorkQueue& queue_;
  v1::InsertScanRequest scan_;
  StopRule::Clock::time_point received_;
};

}  // namespace nbvopt
