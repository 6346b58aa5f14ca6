// What moved leaves in a map.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>

#include "nbvopt/map/uncertainty_map.hpp"
#include "nbvopt/map/voxel.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

/// Counts ghosts: occupied voxels of a map where the static world has nothing, their centres
/// farther than one and a half voxels from every surface, which is one voxel from what a surface's
/// own voxel reaches to.
class GhostCounter {
 public:
  /// Begins with what the map holds. The scene must outlive it.
  GhostCounter(const Scene& scene, const UncertaintyMap& map);

  /// Follows what an insertion changed.
  void update(std::span<const VoxelChange> changes);

  std::uint64_t ghosts() const { return ghosts_; }

 private:
  void set_occupied(VoxelKey key, bool is_occupied);
  bool is_in_the_free(VoxelKey key) const;

  struct Place {
    bool is_in_the_free;
    bool is_occupied;
  };

  const Scene& scene_;
  Lattice lattice_;
  std::unordered_map<std::uint64_t, Place> places_;  ///< of all voxels that were ever occupied
  std::uint64_t ghosts_ = 0;
};

}  // namespace nbvopt
