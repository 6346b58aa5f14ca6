// How much a view would make known.
#pragma once

#include <cstdint>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {

/// The mutual information of map and view where what is unknown is known for sure once it was
/// crossed: the volume of the unknown voxels that rays cross, each counted once. Rays pass what is
/// unknown, and end at an occupied voxel or their range.
class ViewInformation {
 public:
  /// Of views by the planning rays of this camera.
  explicit ViewInformation(const SensorOptions& camera) : camera_(camera) {}

  /// In m3. The grid must be whole, and hold the camera.
  double volume_m3(const VoxelGrid& grid, const Transform& T_map_sensor);

 private:
  DepthCamera camera_;
  std::vector<std::uint64_t> window_;  ///< kept from view to view, for its memory
};

}  // namespace nbvopt
