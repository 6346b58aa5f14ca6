// All voxels that a view's rays pierce, for gains that look at more than the first.
#pragma once

#include <span>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt::detail {

/// A voxel on a ray.
struct RayVoxel {
  VoxelKey key;
  VoxelState state = VoxelState::unknown;
  bool is_beside_surface = false;  ///< unknown, and shares a face with an occupied voxel
};

/// Of each ray of a view the voxels from the one that holds its point at range_min to the first
/// occupied one, included, or to range_max; nothing of a ray that is blocked before range_min.
class ViewRays {
 public:
  std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::span<const RayVoxel> ray(std::size_t i) const {
    return std::span(voxels_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }

  /// Walks the camera's rays through the grid, one at a time; the storage is reused. Throws
  /// InputError when the pose is not finite or lies off the lattice.
  void walk(const VoxelGrid& grid, const DepthCamera& camera, const Transform& T_map_sensor);

 private:
  std::vector<RayVoxel> voxels_;    ///< ray after ray
  std::vector<std::size_t> begin_;  ///< of each ray, and the end
};

/// Whether the ray ends at a surface that the map shows.
inline bool ends_occupied(std::span<const RayVoxel> ray) {
  return !ray.empty() && ray.back().state == VoxelState::occupied;
}

}  // namespace nbvopt::detail
