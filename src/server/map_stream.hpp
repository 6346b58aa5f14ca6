// GetMap: the bytes of a map file, in chunks as the client takes them.
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "nbvopt/v1/planner.pb.h"
#include "server/limits.hpp"
#include "server/queued_call.hpp"
#include "server/receive_watch.hpp"
#include "server/request_handler.hpp"

namespace nbvopt {

/// Deletes itself when the stream has ended. A client that leaves a chunk untaken for too long is
/// left alone: it holds a copy of the map.
class MapStreamCall final : public grpc::ServerWriteReactor<v1::MapChunk>, private ReceivingCall {
 public:
  /// `watch` tells how long the client may take to receive a chunk.
  MapStreamCall(grpc::CallbackServerContext& context, const v1::GetMapRequest& request,
                const RequestHandler& handler, CallLog& log, WorkQueue& queue, OpenStreams& streams,
                ReceiveWatch& watch)
      : context_(context),
        request_(request),
        handler_(handler),
        log_(log),
        place_(streams),
        watch_(watch) {
    if (place_.is_taken() && queue.try_post([this] { copy_map(); })) return;
    log_.record_shed(Method::get_map);
    Finish(shed_status());
  }

 private:
  void copy_map() {
    if (cancel_.is_cancelled()) return Finish(grpc::Status::CANCELLED);
    const grpc::Status status =
        logged(log_, Method::get_map, received_, [this] { map_ = handler_.get_map(request_); });
    if (!status.ok()) return Finish(status);
    chunk_.set_map_version(map_->version);
    chunk_.set_total_bytes(map_->bytes.size());
    write_chunk();
  }

  void write_chunk() {
    constexpr std::size_t kChunkBytes = 1 << 20;
    std::string& data = *chunk_.mutable_data();
    data.clear();
    for (; piece_ < pieces().size() && data.size() < kChunkBytes;) {
      const std::string& piece = *pieces()[piece_];
      const std::size_t count = std::min(kChunkBytes - data.size(), piece.size() - sent_of_piece_);
      data.append(piece, sent_of_piece_, count);
      sent_of_piece_ += count;
      if (sent_of_piece_ < piece.size()) break;
      ++piece_;
      sent_of_piece_ = 0;
    }
    watch_.add(*this);
    StartWrite(&chunk_);
  }

  const std::vector<SharedBytes::Piece>& pieces() const { return map_->bytes.pieces(); }

  void OnWriteDone(bool ok) override {
    if (!watch_.remove(*this)) return end_stalled();
    if (!ok || piece_ == pieces().size()) return Finish(grpc::Status::OK);
    write_chunk();
  }

  void end_late() override {
    context_.TryCancel();  // the write at work fails
    end_stalled();
  }

  /// Called by the watch and by the write that it ended, in either order; the last ends the stream.
  void end_stalled() {
    if (!is_half_ended_.exchange(true)) return;
    log_.record_failure(Method::get_map, grpc::StatusCode::DEADLINE_EXCEEDED);
    Finish({grpc::StatusCode::DEADLINE_EXCEEDED, "the map was not taken, see max_send_s"});
  }

  void OnCancel() override { cancel_.cancel(); }
  void OnDone() override { delete this; }

  grpc::CallbackServerContext& context_;
  const v1::GetMapRequest request_;
  const RequestHandler& handler_;
  CallLog& log_;
  const StopRule::Clock::time_point received_ = StopRule::Clock::now();
  const OpenStreams::Place place_;
  ReceiveWatch& watch_;
  std::atomic<bool> is_half_ended_{false};
  const CancelToken cancel_;
  std::shared_ptr<const MapBytes> map_;
  std::size_t piece_ = 0;  ///< the first that is not sent to its end
  std::size_t sent_of_piece_ = 0;
  v1::MapChunk chunk_;
};

}  // namespace nbvopt
