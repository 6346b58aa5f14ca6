#include "server/plan_stream.hpp"

#include <memory>
#include <utility>

namespace nbvopt {

PlanStreamCall::PlanStreamCall(const grpc::CallbackServerContext& context,
                               const RequestHandler& handler, CallLog& log, WorkQueue& queue,
                               OpenStreams& streams, MessageMemory& memory)
    : limits_(context),
      client_(streams_of(context)),
      handler_(handler),
      log_(log),
      queue_(queue),
      place_(streams),
      memory_(memory) {
  if (place_.is_taken()) {
    StartRead(&incoming_);
  } else {
    log_.record_shed(Method::plan_stream);
    end(shed_status());
  }
}

void PlanStreamCall::OnReadDone(bool ok) {
  bool read_on = false;
  {
    const std::scoped_lock lock(mutex_);
    if (ok) {
      auto share = std::make_unique<MessageMemory::Share>(memory_, incoming_.SpaceUsedLong());
      if (share->is_granted()) {
        newest_ = State{std::move(incoming_), StopRule::Clock::now(), std::move(share)};
      } else {
        log_.record_shed(Method::plan_stream);
        newest_.reset();
        outcome_ = shed_status();
      }
      incoming_ = {};
    }
    read_on = ok && outcome_.ok() && !ended_;
    if (!read_on) all_read_ = true;  // or the client is gone
  }
  if (read_on) StartRead(&incoming_);
  go_on();
}

void PlanStreamCall::OnWriteDone(bool ok) {
  {
    const std::scoped_lock lock(mutex_);
    busy_ = false;
    if (!ok) {
      all_read_ = true;
      newest_.reset();
    }
  }
  go_on();
}

void PlanStreamCall::go_on() {
  bool has_work = false;
  {
    const std::scoped_lock lock(mutex_);
    if (busy_ || ended_) return;
    has_work = newest_.has_value();
    if (!has_work && !all_read_) return;
    if (has_work) {
      busy_ = true;
      planned_ = std::move(*newest_);
      newest_.reset();
    } else {
      ended_ = true;
    }
  }
  if (!has_work) return Finish(outcome_);
  if (queue_.try_post([this] { plan(); }, client_)) return;
  log_.record_shed(Method::plan_stream);
  end(shed_status());
}

void PlanStreamCall::plan() {
  const grpc::Status status = logged(log_, Method::plan_stream, planned_.received, [this] {
    reply_ = handler_.plan(planned_.request, planned_.received, limits_.stop());
  });
  planned_ = {};  // it may be large, and the next one may be long in coming
  if (!status.ok()) return end(status);
  StartWrite(&reply_);
}

void PlanStreamCall::end(const grpc::Status& status) {
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
  }
  Finish(status);
}

}  // namespace nbvopt
