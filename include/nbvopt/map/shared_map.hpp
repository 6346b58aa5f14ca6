// A map, and the one voxel grid on which everything that looks at it casts rays.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt {

/// The grid is filled as rays need it until a scan is inserted, and follows the map from then on;
/// no version of it ever changes. Whoever looks at the map itself while other threads insert scans
/// has to hold() it meanwhile.
class SharedMap {
 public:
  explicit SharedMap(UncertaintyMap map);

  const UncertaintyMap& map() const { return map_; }

  /// The newest version of the map's voxels; made when it is first asked for. Version 1 is the map
  /// that this was made of, and every scan makes one more. Thread-safe.
  std::shared_ptr<const VoxelGrid> grid() const;

  /// No scan is inserted while the lock is held.
  std::shared_lock<std::shared_mutex> hold() const { return std::shared_lock(mutex_); }

  /// Inserts a scan as insert_scan() does, once nobody holds the map.
  InsertResult insert(const Scan& scan, const Transform& T_map_sensor, const SensorOptions& sensor);

 private:
  mutable std::shared_mutex mutex_;  ///< of the map
  UncertaintyMap map_;
  std::uint64_t version_ = 1;

  mutable std::mutex grid_mutex_;                  ///< of the pointer, and of what it is made from
  mutable std::shared_ptr<const VoxelGrid> grid_;  ///< null: not asked for yet
};

}  // namespace nbvopt
