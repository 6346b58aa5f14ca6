// What maps and grids are made of, for the library's own modules: files, scans, ray casters.
#pragma once

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt::detail {

struct MapAccess {
  static const UncertaintyOcTree& tree(const UncertaintyMap& map) { return *map.tree_; }
  /// For writing.
  static UncertaintyOcTree& tree(UncertaintyMap& map) {
    map.is_plain_ = false;
    return *map.tree_;
  }
  static const BrickTable& table(const VoxelGrid& grid) { return *grid.table_; }
};

}  // namespace nbvopt::detail
