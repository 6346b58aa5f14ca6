#include "sim/people/ghosts.hpp"

#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"

namespace nbvopt {
namespace {

/// Calls visit(key) for all voxels that a leaf covers.
template <class Visit>
void for_each_covered(VoxelKey least, int depth, const Visit& visit) {
  const int size = 1 << (UncertaintyOcTree::kDepth - depth);
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      for (int z = 0; z < size; ++z) {
        visit(VoxelKey{static_cast<std::uint16_t>(least.x + x),
                       static_cast<std::uint16_t>(least.y + y),
                       static_cast<std::uint16_t>(least.z + z)});
      }
    }
  }
}

}  // namespace

GhostCounter::GhostCounter(const Scene& scene, const UncertaintyMap& map)
    : scene_(scene), lattice_(map.lattice()) {
  const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
  for_each_leaf(tree, [&](const UncertaintyOcTreeNode& leaf, VoxelKey least, int depth) {
    if (!tree.isNodeOccupied(&leaf)) return;
    for_each_covered(least, depth, [&](VoxelKey key) { set_occupied(key, true); });
  });
}

void GhostCounter::update(std::span<const VoxelChange> changes) {
  for (const VoxelChange& change : changes) {
    set_occupied(change.key, change.state == VoxelState::occupied);
  }
}

void GhostCounter::set_occupied(VoxelKey key, bool is_occupied) {
  auto place = places_.find(packed(key));
  if (place == places_.end()) {
    if (!is_occupied) return;
    place = places_.emplace(packed(key), Place{is_in_the_free(key), false}).first;
  }
  if (place->second.is_in_the_free && place->second.is_occupied != is_occupied) {
    is_occupied ? ++ghosts_ : --ghosts_;
  }
  place->second.is_occupied = is_occupied;
}

bool GhostCounter::is_in_the_free(VoxelKey key) const {
  return !scene_.has_surface_within(lattice_.centre_m(key),
                                    static_cast<float>(1.5 * lattice_.resolution_m()));
}

}  // namespace nbvopt
