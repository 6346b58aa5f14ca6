#include "server/snapshot_keeper.hpp"

#include <spdlog/spdlog.h>

#include <system_error>
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
  std::error_code ignored;
  if (store_.published()->map_version() == state().durable_version &&
      std::filesystem::exists(path_, ignored)) {
    return;
  }
  try {
    const auto map = store_.bytes(MapFormat::uncertainty_ot);
    write_snapshot(path_, *map);
    spdlog::debug("event=snapshot map_version={} bytes={}", map->version, map->bytes.size());
    const std::scoped_lock lock(mutex_);
    state_ = {map->version, {}};
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
