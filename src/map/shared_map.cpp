#include "nbvopt/map/shared_map.hpp"

#include <utility>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

SharedMap::SharedMap(UncertaintyMap map) : map_(std::move(map)) {}

std::shared_ptr<const VoxelGrid> SharedMap::grid() const {
  const std::scoped_lock lock(grid_mutex_);
  if (!grid_) grid_ = version_ == 1 ? VoxelGrid::lazy(map_) : VoxelGrid::whole(map_, version_);
  return grid_;
}

InsertResult SharedMap::insert(const Scan& scan, const Transform& T_map_sensor,
                               const SensorOptions& sensor) {
  const std::scoped_lock lock(mutex_, grid_mutex_);
  if (grid_) grid_->read_all();
  // Where memory runs out half way, the next grid is made of the map as it then is.
  const std::shared_ptr<const VoxelGrid> before = std::move(grid_);
  ++version_;
  InsertResult inserted;
  try {
    inserted = insert_scan(map_, scan, T_map_sensor, sensor);
  } catch (const Error&) {  // refused: the map is untouched
    --version_;
    grid_ = before;
    throw;
  }
  if (before) grid_ = before->updated(inserted.changes);
  return inserted;
}

}  // namespace nbvopt
