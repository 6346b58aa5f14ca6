#include "server/snapshot_keeper.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "server/snapshot_file.hpp"

namespace nbvopt {

SnapshotKeeper::SnapshotKeeper(const MapStore& store, std::filesystem::path path,
                               std::chrono::milliseconds every)
    : store_(store), path_(std::move(path)), every_(every) {
  thread_ = std::thread([this] { run(); });
}

SnapshotKeeper::~SnapshotKeeper() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

SnapshotKeeper::State SnapshotKeeper::state() const {
  const std::scoped_lock lock(mutex_);
  return state_;
}

void SnapshotKeeper::save() {
  const std::scoped_lock one_writer(writing_);
  if (store_.published()->version() == state().durable_version) return;
  try {
    MapBytes map = store_.bytes(MapFormat::uncertainty_ot);
    const std::uint64_t version = map.version;
    const std::size_t bytes = map.bytes.size();
    write_snapshot(path_, std::move(map));
    spdlog::debug("event=snapshot map_version={} bytes={}", version, bytes);
    const std::scoped_lock lock(mutex_);
    state_ = {version, {}};
  } catch (const std::exception& error) {
    const std::scoped_lock lock(mutex_);
    state_.error = error.what();
    throw;
  }
}

void SnapshotKeeper::run() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, every_, [this] { return closing_; })) {
    lock.unlock();
    try {
      save();
    } catch (const std::exception& error) {
      spdlog::error("event=snapshot_failed error=\"{}\"", error.what());
    }
    lock.lock();
  }
}

}  // namespace nbvopt
