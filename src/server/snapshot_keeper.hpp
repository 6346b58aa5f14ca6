// Keeps a snapshot of the map on disk, again and again.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "server/map_store.hpp"

namespace nbvopt {

/// Safe to share between threads. The map is copied between scans; the disk keeps nobody
/// waiting.
class SnapshotKeeper {
 public:
  SnapshotKeeper(const MapStore& store, std::filesystem::path path,
                 std::chrono::milliseconds every);
  SnapshotKeeper(const SnapshotKeeper&) = delete;
  SnapshotKeeper& operator=(const SnapshotKeeper&) = delete;
  ~SnapshotKeeper();

  struct State {
    std::uint64_t durable_version = 0;  ///< of the last complete snapshot; 0: none yet
    std::string error;                  ///< why the last attempt failed; empty when it did not
  };
  State state() const;

  /// Writes a snapshot now, unless the map is the same as on disk. Throws InputError when it cannot
  /// be written; the last complete one is then untouched.
  void save();

 private:
  void run();

  const MapStore& store_;
  const std::filesystem::path path_;
  const std::chrono::milliseconds every_;

  std::mutex writing_;        ///< one writer at a time
  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  State state_;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace nbvopt
