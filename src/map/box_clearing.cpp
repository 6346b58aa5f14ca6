#include "map/box_clearing.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// The part of an edge of voxels, from `origin` on, that lies between two keys; both ends included.
struct Span {
  Span(int origin, int size, int min, int max)
      : first(std::max(origin, min)), last(std::min(origin + size - 1, max)) {}
  std::uint64_t size() const {
    return first > last ? 0 : static_cast<std::uint64_t>(last - first) + 1;
  }
  int first, last;
};

/// The known voxels of the box that are not as free as can be.
std::vector<VoxelKey> voxels_to_clear(const UncertaintyOcTree& tree, const KeyBox& box) {
  std::vector<VoxelKey> voxels;
  for_each_leaf(tree, [&](const UncertaintyOcTreeNode& leaf, VoxelKey origin, int depth) {
    const int size = 1 << (UncertaintyOcTree::kDepth - depth);
    const Span x(origin.x, size, box.min.x, box.max.x);
    const Span y(origin.y, size, box.min.y, box.max.y);
    const Span z(origin.z, size, box.min.z, box.max.z);
    if (x.size() * y.size() * z.size() == 0) return;
    if (leaf.getLogOdds() <= tree.getClampingThresMinLog()) return;
    if (voxels.size() + x.size() * y.size() * z.size() > kMostClearedVoxels) {
      throw InputError("the box holds more than " + std::to_string(kMostClearedVoxels) +
                       " known voxels: clear a smaller one, or the whole map");
    }
    for (int k = z.first; k <= z.last; ++k) {
      for (int j = y.first; j <= y.last; ++j) {
        for (int i = x.first; i <= x.last; ++i) {
          voxels.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                            static_cast<std::uint16_t>(k)});
        }
      }
    }
  });
  return voxels;
}

VoxelKey tile_of(VoxelKey voxel) {
  constexpr unsigned kWithin = 64 - 1;
  return {static_cast<std::uint16_t>(voxel.x & ~kWithin),
          static_cast<std::uint16_t>(voxel.y & ~kWithin),
          static_cast<std::uint16_t>(voxel.z & ~kWithin)};
}

}  // namespace

BoxClearing clear_box(UncertaintyMap& map, const KeyBox& box) {
  const UncertaintyOcTree& tree = detail::MapAccess::tree(std::as_const(map));
  const float free_log_odds = tree.getClampingThresMinLog();
  BoxClearing clearing;
  for (const VoxelKey& voxel : voxels_to_clear(tree, box)) {
    if (map.at(voxel).state == VoxelState::occupied) {
      clearing.changes.push_back({.key = voxel, .state = VoxelState::free});
    }
    map.set(voxel, {.state = VoxelState::free, .log_odds = free_log_odds});
    clearing.tiles.push_back(tile_of(voxel));
  }
  std::ranges::sort(clearing.tiles, {}, packed);
  clearing.tiles.erase(std::unique(clearing.tiles.begin(), clearing.tiles.end()),
                       clearing.tiles.end());
  map.finish_writing();
  return clearing;
}

}  // namespace nbvopt
