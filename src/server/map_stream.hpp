// GetMap: the bytes of a map file, in chunks as the client takes them.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "nbvopt/v1/planner.pb.h"
#include "server/limits.hpp"
#include "server/queued_call.hpp"
#include "server/request_handler.hpp"

namespace nbvopt {

/// Deletes itself when the stream has ended.
class MapStreamCall final : public grpc::ServerWriteReactor<v1::MapChunk> {
 public:
  MapStreamCall(const v1::GetMapRequest& request, const RequestHandler& handler, CallLog& log,
                WorkQueue& queue, OpenStreams& streams)
      : request_(request), handler_(handler), log_(log), place_(streams) {
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
    StartWrite(&chunk_);
  }

  const std::vector<SharedBytes::Piece>& pieces() const { return map_->bytes.pieces(); }

  void OnWriteDone(bool ok) override {
    if (!ok || piece_ == pieces().size()) return Finish(grpc::Status::OK);
    write_chunk();
  }

  void OnCancel() override { cancel_.cancel(); }
  void OnDone() override { delete this; }

  const v1::GetMapRequest request_;
  const RequestHandler& handler_;
  CallLog& log_;
  const StopRule::Clock::time_point received_ = StopRule::Clock::now();
  const OpenStreams::Place place_;
  const CancelToken cancel_;
  std::shared_ptr<const MapBytes> map_;
  std::size_t piece_ = 0;  ///< the first that is not sent to its end
  std::size_t sent_of_piece_ = 0;
  v1::MapChunk chunk_;
};

}  // namespace nbvopt
