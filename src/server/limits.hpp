// What one client may ask of the server.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace nbvopt {

/// Each is an option of `nbvopt serve`, which messages name.
struct ServerLimits {
  std::int64_t max_message_mib = 16;
  std::int64_t max_scan_points = 2'000'000;
  std::int64_t max_views = 10'000;   ///< a call of Evaluate
  double max_map_extent_m = 500.0;   ///< the longest side of the map's box
  double min_resolution_m = 0.01;    ///< the smallest voxels of a map
  std::int64_t max_map_mib = 2048;   ///< of the map: tree, bricks that plans read, and copies
  double max_compute_ms = 10'000.0;  ///< of a plan or a call of Evaluate
  std::int64_t max_waiting = 64;     ///< calls of a client that wait for a thread, by kind of work
  std::int64_t max_streams = 256;    ///< streams that are open
  /// Of all messages that are coming in, and again of all that wait or are at work.
  std::int64_t max_buffered_mib = 256;
  double max_receive_s = 30.0;  ///< until a call's message must be there
  double max_send_s = 10.0;     ///< until a client must have taken a part of a map, 1 MiB
  /// Of copies that clients take of older versions of the map, when another asks for one.
  std::int64_t max_pinned_mib = 256;
  /// Of clients; fewer where the system allows the process few descriptors.
  std::int64_t max_connections = 256;
  /// Of browsers and monitors; half of them may stay and be told of changes.
  std::int64_t max_web_connections = 32;
};

/// How many streams are open: each holds memory of its own.
class OpenStreams {
 public:
  explicit OpenStreams(std::int64_t most) : most_(most) {}

  /// A place among the open streams, given back when it goes.
  class Place {
   public:
    explicit Place(OpenStreams& streams)
        : streams_(streams), is_taken_(++streams.open_ <= streams.most_) {}
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    ~Place() { --streams_.open_; }

    /// False: there was none left.
    bool is_taken() const { return is_taken_; }

   private:
    OpenStreams& streams_;
    bool is_taken_;
  };

  std::int64_t open() const { return open_; }

 private:
  const std::int64_t most_;
  std::atomic<std::int64_t> open_{0};
};

/// How much memory messages take that wait or are at work.
class MessageMemory {
 public:
  explicit MessageMemory(std::int64_t most_mib) : most_(static_cast<std::size_t>(most_mib) << 20) {}

  /// A message's part of it, given back when it goes.
  class Share {
   public:
    Share(MessageMemory& memory, std::size_t bytes)
        : memory_(memory), bytes_(bytes), is_granted_(memory.take(bytes)) {}
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    ~Share() { memory_.taken_ -= bytes_; }

    /// False: there was too little left. A message alone always finds enough.
    bool is_granted() const { return is_granted_; }

   private:
    MessageMemory& memory_;
    std::size_t bytes_;
    bool is_granted_;
  };

  std::size_t taken_bytes() const { return taken_; }

 private:
  bool take(std::size_t bytes) {
    const std::size_t now = taken_ += bytes;
    return now <= most_ || now == bytes;
  }

  const std::size_t most_;
  std::atomic<std::size_t> taken_{0};
};

}  // namespace nbvopt
