// A map file, and the one grid on which everything that looks at it casts rays.
#pragma once

#include <filesystem>
#include <memory>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt::python {

/// Whatever is made of a map keeps a pointer to this, so that the map outlives it. Never changes.
class SharedMap {
 public:
  /// Throws InputError as read_map() does.
  explicit SharedMap(const std::filesystem::path& path);

  const UncertaintyMap& map() const { return map_; }
  const std::shared_ptr<const VoxelGrid>& grid() const { return grid_; }

 private:
  UncertaintyMap map_;
  std::shared_ptr<const VoxelGrid> grid_;  ///< filled as rays need it
};

}  // namespace nbvopt::python
