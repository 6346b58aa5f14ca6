// A call of one message and one reply.
#pragma once

#include <grpcpp/grpcpp.h>

#include <optional>
#include <string>
#include <utility>

#include "server/limits.hpp"
#include "server/queued_call.hpp"
#include "server/receive_watch.hpp"

namespace nbvopt {

/// What unary calls share, and where they are done.
struct UnaryCallParts {
  CallLog& log;
  ReceiveWatch& watch;
  MessageMemory& memory;
};

/// A call of one message and one reply. To gRPC it is a stream of each: for a unary method it would
/// read the message before it tells anybody of the call, so that one that does not come to its end
/// could be neither counted nor ended. On the wire the two are the same.
///
/// `queue_of(request)` chooses where it is done, `run(request, limits)` makes the reply and may
/// throw. Deletes itself when the call has ended.
template <typename Request, typename Reply, typename QueueOf, typename Run>
class UnaryCall final : public grpc::ServerBidiReactor<Request, Reply>, private ReceivingCall {
 public:
  UnaryCall(const grpc::CallbackServerContext& context, const UnaryCallParts& parts, Method method,
            QueueOf queue_of, Run run)
      : limits_(context),
        client_(calls_of(context)),
        parts_(parts),
        method_(method),
        queue_of_(std::move(queue_of)),
        run_(std::move(run)) {
    parts_.watch.add(*this);
    this->StartRead(&request_);
  }

 private:
  void OnReadDone(bool ok) override {
    if (!parts_.watch.remove(*this)) return;
    if (!ok) {  // or the client is gone, or the message was too much
      fail({grpc::StatusCode::INVALID_ARGUMENT, "the call has no message that can be read"});
      return;
    }
    limits_.restart();
    share_.emplace(parts_.memory, request_.SpaceUsedLong());
    if (share_->is_granted() && queue_of_(request_).try_post([this] { work(); }, client_)) return;
    parts_.log.record_shed(method_);
    this->Finish(shed_status());
  }

  void end_late() override {
    fail({grpc::StatusCode::DEADLINE_EXCEEDED, "the message took too long to come"});
  }

  void work() {
    if (limits_.stop().cancel.is_cancelled()) {
      return fail({grpc::StatusCode::CANCELLED, "cancelled while it waited"});
    }
    const grpc::Status status = logged(parts_.log, method_, limits_.received(),
                                       [this] { reply_ = run_(request_, limits_); });
    if (!status.ok()) return this->Finish(status);
    this->StartWriteAndFinish(&reply_, {}, grpc::Status::OK);
  }

  void fail(const grpc::Status& status) {
    parts_.log.record_failure(method_, status.error_code());
    this->Finish(status);
  }

  void OnCancel() override { limits_.cancel(); }
  void OnDone() override { delete this; }

  CallLimits limits_;
  const std::string client_;
  const UnaryCallParts parts_;
  const Method method_;
  const QueueOf queue_of_;
  const Run run_;
  Request request_;
  Reply reply_;
  std::optional<MessageMemory::Share> share_;
};

}  // namespace nbvopt
