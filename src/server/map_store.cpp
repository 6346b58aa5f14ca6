#include "server/map_store.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>
#include <utility>

#include "core/number.hpp"
#include "map/box_clearing.hpp"
#include "nbvopt/core/error.hpp"
#include "protocol/limit_error.hpp"

namespace nbvopt {

MapStore::MapStore(const Robot& robot, const ServerLimits& limits, UncertaintyMap map,
                   std::uint64_t version, const HazardTable& hazards)
    : robot_(robot),
      limits_(limits),
      map_(std::move(map)),
      extent_m_(checked_extent_m(map_)),
      hazards_(hazards) {
  publish(VoxelGrid::whole(map_, version), map_.memory_bytes());
}

std::shared_ptr<const ViewPlanner> MapStore::published() const {
  const std::scoped_lock lock(published_mutex_);
  return published_;
}

void MapStore::publish(std::shared_ptr<const VoxelGrid> grid, std::uint64_t tree_bytes) {
  map_bytes_ = tree_bytes + grid->memory_bytes();
  auto published = std::make_shared<const ViewPlanner>(grid, robot_, hazards_);
  grid_ = std::move(grid);
  const std::scoped_lock lock(published_mutex_);
  published_.swap(published);  // the old version, if nobody reads it, goes after the lock
}

MapStore::Insertion MapStore::insert(const Scan& scan, const Transform& T_map_sensor,
                                     const CancelToken& cancel) {
  const std::scoped_lock lock(tree_mutex_);
  const std::uint64_t used_bytes = map_.memory_bytes() + grid_->memory_bytes() + held_.bytes();
  check_size(used_bytes);
  Eigen::AlignedBox3d extent_m = extent_m_;
  const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(robot_.sensor.longest_range_m());
  extent_m.extend(T_map_sensor.translation() - reach_m);
  extent_m.extend(T_map_sensor.translation() + reach_m);
  check_extent(extent_m);
  if (is_grid_behind_) publish_whole();
  is_grid_behind_ = false;

  Insertion insertion;
  HazardTable hazards = hazards_;
  if (robot_.sensor.gain.has(GainKind::expected)) {
    learn_hazards(*grid_, scan, T_map_sensor, robot_.sensor, hazards);
  }
  try {
    insertion.result = insert_scan(map_, scan, T_map_sensor, robot_.sensor,
                                   {.cancel = cancel, .max_bytes = max_bytes() - used_bytes});
  } catch (const ScanTooLargeError& error) {
    throw LimitError(error.what() + limit_text());
  } catch (const Error&) {  // refused: the tree is untouched
    throw;
  } catch (...) {
    is_grid_behind_ = true;
    image_.forget_all();
    throw;
  }
  image_.forget(insertion.result.tiles);
  extent_m_ = extent_m;
  hazards_ = hazards;
  is_grid_behind_ = true;
  publish(grid_->updated(insertion.result.changes), map_.memory_bytes());
  is_grid_behind_ = false;
  insertion.version = grid_->version();
  return insertion;
}

std::uint64_t MapStore::replace(UncertaintyMap map) {
  const Eigen::AlignedBox3d extent_m = checked_extent_m(map);
  const std::scoped_lock lock(tree_mutex_);
  publish(VoxelGrid::whole(map, grid_->version() + 1), map.memory_bytes());
  map_ = std::move(map);
  image_.forget_all();
  extent_m_ = extent_m;
  is_grid_behind_ = false;
  return grid_->version();
}

std::uint64_t MapStore::clear(std::optional<double> resolution_m) {
  const double same_m = published()->grid()->lattice().resolution_m();
  return replace(UncertaintyMap(resolution_m.value_or(same_m)));
}

std::uint64_t MapStore::clear_box(const KeyBox& box) {
  const std::scoped_lock lock(tree_mutex_);
  if (is_grid_behind_) publish_whole();
  is_grid_behind_ = false;
  BoxClearing clearing;
  try {
    clearing = nbvopt::clear_box(map_, box);
  } catch (const Error&) {  // refused: the tree is untouched
    throw;
  } catch (...) {
    is_grid_behind_ = true;
    image_.forget_all();
    throw;
  }
  image_.forget(clearing.tiles);
  is_grid_behind_ = true;
  publish(grid_->updated(clearing.changes), map_.memory_bytes());
  is_grid_behind_ = false;
  return grid_->version();
}

std::shared_ptr<const MapBytes> MapStore::bytes(MapFormat format) const {
  const std::scoped_lock lock(bytes_mutex_);
  std::weak_ptr<const MapBytes>& last = bytes_[format];
  std::shared_ptr<const MapBytes> bytes = last.lock();
  if (bytes != nullptr && bytes->version == published()->map_version()) return bytes;
  MapBytes made = copy();
  if (format != MapFormat::uncertainty_ot) {
    std::istringstream file(made.bytes.joined());
    made.bytes = SharedBytes(held_.hold(map_file_bytes(read_map(file, "the map"), format)));
  }
  bytes = std::make_shared<const MapBytes>(std::move(made));
  last = bytes;
  return bytes;
}

MapBytes MapStore::copy() const {
  constexpr std::chrono::milliseconds kSlice{2};
  std::unique_lock lock(tree_mutex_);
  const std::vector<VoxelKey> tiles = image_.missing(map_);
  auto slice_end = StopRule::Clock::now() + kSlice;
  for (const VoxelKey& tile : tiles) {
    image_.copy(map_, tile);
    if (StopRule::Clock::now() < slice_end) continue;
    lock.unlock();
    std::this_thread::sleep_for(kSlice);  // or this thread might take the lock again at once
    lock.lock();
    slice_end = StopRule::Clock::now() + kSlice;
  }
  // What scans have written meanwhile is copied again.
  MapBytes made{image_.file(map_), grid_->version(), std::nullopt};
  if (robot_.sensor.gain.has(GainKind::expected)) made.hazards = hazards_;
  return made;
}

std::uint64_t MapStore::pinned_bytes() const {
  const std::scoped_lock lock(tree_mutex_);
  return held_.bytes() - std::min(held_.bytes(), image_.bytes());
}

VersionedCounts MapStore::counts() const {
  const std::scoped_lock lock(tree_mutex_);
  if (counts_.version != grid_->version()) {
    counts_ = {map_.counts(), map_.paper_counts(), grid_->version()};
  }
  return counts_;
}

void MapStore::check_extent(const Eigen::AlignedBox3d& box_m) const {
  const double side_m = box_m.sizes().maxCoeff();
  if (box_m.isEmpty() || side_m <= limits_.max_map_extent_m) return;
  throw LimitError("the map would be " + format_number(side_m) + " m long, the limit is " +
                   format_number(limits_.max_map_extent_m) + " m (max_map_extent_m)");
}

void MapStore::check_size(std::uint64_t bytes) const {
  if (bytes <= max_bytes()) return;
  throw LimitError("the map takes " + std::to_string((bytes >> 20) + 1) + " MiB" + limit_text());
}

std::uint64_t MapStore::max_bytes() const {
  return static_cast<std::uint64_t>(limits_.max_map_mib) << 20;
}

std::string MapStore::limit_text() const {
  return ", the limit is " + std::to_string(limits_.max_map_mib) + " MiB (max_map_mib)";
}

Eigen::AlignedBox3d MapStore::checked_extent_m(const UncertaintyMap& map) const {
  if (map.resolution_m() < limits_.min_resolution_m ||
      map.resolution_m() > limits_.max_map_extent_m) {
    throw LimitError("the map's voxels would be " + format_number(map.resolution_m()) +
                     " m wide, the limits are " + format_number(limits_.min_resolution_m) +
                     " m (min_resolution_m) and " + format_number(limits_.max_map_extent_m) +
                     " m (max_map_extent_m)");
  }
  Eigen::AlignedBox3d box_m;
  if (const auto box = map.known_box()) {
    box_m.extend(map.lattice().centre_m(box->min));
    box_m.extend(map.lattice().centre_m(box->max));
  }
  check_extent(box_m);
  constexpr std::uint64_t kBytesPerBrick = 45'000;
  check_size(map.memory_bytes() + map.known_bricks() * kBytesPerBrick);
  return box_m;
}

}  // namespace nbvopt
