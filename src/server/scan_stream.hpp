// InsertScans: a client's stream of scans, inserted and acknowledged one after the other.
#pragma once

#include <optional>
#include <string>

#include "nbvopt/v1/planner.pb.h"
#include "server/limits.hpp"
#include "server/queued_call.hpp"
#include "server/request_handler.hpp"

namespace nbvopt {

/// Deletes itself when the stream has ended. The next scan is read when the last one is
/// acknowledged, so that a fast client waits instead of filling the server's memory.
class ScanStreamCall final
    : public grpc::ServerBidiReactor<v1::InsertScanRequest, v1::InsertScanReply> {
 public:
  ScanStreamCall(const grpc::CallbackServerContext& context, RequestHandler& handler, CallLog& log,
                 WorkQueue& queue, OpenStreams& streams, MessageMemory& memory)
      : client_(streams_of(context)),
        handler_(handler),
        log_(log),
        queue_(queue),
        place_(streams),
        memory_(memory) {
    if (place_.is_taken()) {
      StartRead(&scan_);
    } else {
      shed();
    }
  }

 private:
  void OnReadDone(bool ok) override {
    if (!ok) return Finish(grpc::Status::OK);  // all are read, or the client is gone
    received_ = StopRule::Clock::now();
    share_.emplace(memory_, scan_.SpaceUsedLong());
    if (!share_->is_granted() || !queue_.try_post([this] { insert(); }, client_)) shed();
  }

  void insert() {
    const grpc::Status status = logged(log_, Method::insert_scans, received_,
                                       [this] { reply_ = handler_.insert_scan(scan_, cancel_); });
    if (!status.ok()) return Finish(status);
    scan_ = {};  // it may be large, and the next one may be long in coming
    share_.reset();
    StartWrite(&reply_);
  }

  void OnWriteDone(bool ok) override {
    if (!ok) return Finish(grpc::Status::CANCELLED);
    StartRead(&scan_);
  }

  void shed() {
    log_.record_shed(Method::insert_scans);
    Finish(shed_status());
  }

  void OnCancel() override { cancel_.cancel(); }
  void OnDone() override { delete this; }

  const std::string client_;
  RequestHandler& handler_;
  CallLog& log_;
  WorkQueue& queue_;
  const OpenStreams::Place place_;
  MessageMemory& memory_;
  std::optional<MessageMemory::Share> share_;  ///< of `scan_`
  const CancelToken cancel_;
  v1::InsertScanRequest scan_;
  v1::InsertScanReply reply_;
  StopRule::Clock::time_point received_;
};

}  // namespace nbvopt
