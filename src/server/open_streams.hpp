// How many streams are open: each holds memory of its own.
#pragma once

#include <atomic>
#include <cstdint>

namespace nbvopt {

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

 private:
  const std::int64_t most_;
  std::atomic<std::int64_t> open_{0};
};

}  // namespace nbvopt
