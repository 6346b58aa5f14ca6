// Workers as the coordinator sees them, whatever they are and wherever they run.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiment/work.hpp"

namespace nbvopt::experiment {

/// What has become of a worker.
struct PoolEvent {
  enum class Kind {
    ready,     ///< it was started and takes units now
    answered,  ///< the first of its units has ended
    lost,      ///< it has ended by itself, or another has ended it; it can be started again
  };

  std::size_t worker = 0;
  Kind kind = Kind::ready;
  Outcome outcome = {};  ///< of the unit that was answered
  std::string how = {};  ///< a lost one ended
};

/// Workers, numbered from 0, that do one unit at a time each. None of them is started at first.
class Pool {
 public:
  using Clock = std::chrono::steady_clock;

  /// Leaves nothing running.
  virtual ~Pool() = default;

  virtual std::size_t size() const = 0;

  /// Starts a worker that has not been, was stopped or lost. Throws InputError when it cannot be.
  virtual void start(std::size_t worker) = 0;

  /// How many units a worker can be given before the first of them has ended.
  virtual std::size_t most_units_a_worker() const { return 1; }

  /// Gives units to a worker, which does them after those that it has, in their order. One that has
  /// ended is told of by wait().
  virtual void hand_out(std::size_t worker, std::span<const Unit> units) = 0;

  /// Ends a worker with all units that it has.
  virtual void stop(std::size_t worker) = 0;

  /// Waits for events, until this time and no longer than until the descriptor `wake` is readable.
  /// Throws InputError for what no worker would do.
  virtual std::vector<PoolEvent> wait(Clock::time_point until, int wake) = 0;

  /// Throws InputError that names a file of this machine which a worker elsewhere cannot read, and
  /// the machine. To be called before any worker is started.
  virtual void require_files(std::span<const std::filesystem::path> /*files*/) {}
};

}  // namespace nbvopt::experiment
