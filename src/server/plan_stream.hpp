// PlanStream: the driver sends its state at its own rate, the server answers for the newest.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "nbvopt/v1/planner.pb.h"
#include "server/limits.hpp"
#include "server/queued_call.hpp"
#include "server/request_handler.hpp"

namespace nbvopt {

/// Deletes itself when the stream has ended: gRPC calls OnDone() after Finish(), when no other call
/// of it is under way. Finish() is called where nobody else can be at work: by who holds `busy_`,
/// or while nobody does.
class PlanStreamCall final : public grpc::ServerBidiReactor<v1::PlanRequest, v1::PlanReply> {
 public:
  PlanStreamCall(const grpc::CallbackServerContext& context, const RequestHandler& handler,
                 CallLog& log, WorkQueue& queue, OpenStreams& streams, MessageMemory& memory);

 private:
  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override { limits_.cancel(); }  // its read then fails, which ends the stream
  void OnDone() override { delete this; }

  /// Starts the next plan, or ends the stream, where it is time for that. gRPC may call back from
  /// within what it is told, so it is never told anything under the lock.
  void go_on();
  void plan();
  /// Ends the stream in the middle; by the holder of `busy_`, who does nothing after it.
  void end(const grpc::Status& status);

  /// A state of the robot and when it came.
  struct State {
    v1::PlanRequest request;
    StopRule::Clock::time_point received;
    std::unique_ptr<MessageMemory::Share> share;
  };

  const CallLimits limits_;
  const std::string client_;
  const RequestHandler& handler_;
  CallLog& log_;
  WorkQueue& queue_;
  const OpenStreams::Place place_;
  MessageMemory& memory_;

  v1::PlanRequest incoming_;  ///< gRPC writes it between StartRead() and OnReadDone()
  v1::PlanReply reply_;       ///< gRPC reads it between StartWrite() and OnWriteDone()
  State planned_;             ///< of the plan at work

  std::mutex mutex_;  ///< of what follows
  std::optional<State> newest_;
  bool busy_ = false;  ///< a plan is at work, or its answer under way
  bool all_read_ = false;
  grpc::Status outcome_;  ///< once all is read
  bool ended_ = false;
};

}  // namespace nbvopt
