#include "server/map_store.hpp"

#include <utility>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "protocol/limit_error.hpp"

namespace nbvopt {

MapStore::MapStore(const Robot& robot, const ServerLimits& limits, UncertaintyMap map,
                   std::uint64_t version)
    : robot_(robot), limits_(limits), map_(std::move(map)), extent_m_(checked_extent_m(map_)) {
  publish(VoxelGrid::whole(map_, version));
}

std::shared_ptr<const PublishedMap> MapStore::published() const {
  const std::scoped_lock lock(published_mutex_);
  return published_;
}

void MapStore::publish(std::shared_ptr<const VoxelGrid> grid) {
  auto published = std::make_shared<const PublishedMap>(robot_, grid);
  grid_ = std::move(grid);
  const std::scoped_lock lock(published_mutex_);
  published_.swap(published);  // the old version, if nobody reads it, goes after the lock
}

MapStore::Insertion MapStore::insert(const Scan& scan, const Transform& T_map_sensor) {
  const std::scoped_lock lock(tree_mutex_);
  Eigen::AlignedBox3d extent_m = extent_m_;
  const Eigen::Vector3d reach_m = Eigen::Vector3d::Constant(robot_.sensor.longest_range_m());
  extent_m.extend(T_map_sensor.translation() - reach_m);
  extent_m.extend(T_map_sensor.translation() + reach_m);
  check_extent(extent_m);

  Insertion insertion;
  try {
    insertion.result = insert_scan(map_, scan, T_map_sensor, robot_.sensor);
    extent_m_ = extent_m;
    publish(is_grid_behind_ ? VoxelGrid::whole(map_, grid_->version() + 1)
                            : grid_->updated(insertion.result.changes));
  } catch (const Error&) {  // the scan was refused, the tree is untouched
    throw;
  } catch (...) {  // out of memory, say: the tree may hold what the grid does not
    is_grid_behind_ = true;
    throw;
  }
  is_grid_behind_ = false;
  insertion.version = grid_->version();
  return insertion;
}

std::uint64_t MapStore::replace(UncertaintyMap map) {
  const Eigen::AlignedBox3d extent_m = checked_extent_m(map);
  const std::scoped_lock lock(tree_mutex_);
  publish(VoxelGrid::whole(map, grid_->version() + 1));
  map_ = std::move(map);
  extent_m_ = extent_m;
  is_grid_behind_ = false;
  return grid_->version();
}

std::uint64_t MapStore::clear(std::optional<double> resolution_m) {
  const double same_m = published()->grid().lattice().resolution_m();
  return replace(UncertaintyMap(resolution_m.value_or(same_m)));
}

MapBytes MapStore::bytes(MapFormat format) const {
  const std::scoped_lock lock(tree_mutex_);
  return {map_file_bytes(map_, format), grid_->version()};
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
                   format_number(limits_.max_map_extent_m) + " m (--max-map-extent)");
}

Eigen::AlignedBox3d MapStore::checked_extent_m(const UncertaintyMap& map) const {
  if (map.resolution_m() < limits_.min_resolution_m) {
    throw LimitError("the map's voxels would be " + format_number(map.resolution_m()) +
                     " m wide, the limit is " + format_number(limits_.min_resolution_m) +
                     " m (--min-resolution)");
  }
  Eigen::AlignedBox3d box_m;
  if (const auto box = map.known_box()) {
    box_m.extend(map.lattice().centre_m(box->min));
    box_m.extend(map.lattice().centre_m(box->max));
  }
  check_extent(box_m);
  const std::uint64_t bricks = map.known_bricks();
  if (bricks > static_cast<std::uint64_t>(limits_.max_map_bricks)) {
    throw LimitError("the map holds " + std::to_string(bricks) +
                     " bricks of 32 voxels a side, the limit is " +
                     std::to_string(limits_.max_map_bricks) + " (--max-map-bricks)");
  }
  return box_m;
}

}  // namespace nbvopt
