#include "nbvopt/sim/map_score.hpp"

#include <array>

#include "map/map_access.hpp"
#include "map/uncertainty_octree.hpp"

namespace nbvopt {
namespace {

/// Calls visit(voxel, u) for every occupied voxel at the finest resolution.
template <class Visit>
void for_each_occupied_voxel(const UncertaintyMap& map, const Visit& visit) {
  const UncertaintyOcTree& tree = detail::MapAccess::tree(map);
  for_each_leaf(tree, [&](const UncertaintyOcTreeNode& leaf, VoxelKey origin, int depth) {
    if (!tree.isNodeOccupied(&leaf)) return;
    const int size = 1 << (UncertaintyOcTree::kDepth - depth);
    for (int z = 0; z < size; ++z) {
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          visit(VoxelKey{static_cast<std::uint16_t>(origin.x + x),
                         static_cast<std::uint16_t>(origin.y + y),
                         static_cast<std::uint16_t>(origin.z + z)},
                leaf.uncertainty());
        }
      }
    }
  });
}

/// Whether the voxel or one that shares a face with it is occupied.
bool is_occupied_about(const UncertaintyMap& map, VoxelKey key) {
  constexpr std::array<std::array<int, 3>, 7> kSteps{
      {{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  for (const auto& [x, y, z] : kSteps) {
    const VoxelKey beside{static_cast<std::uint16_t>(key.x + x),
                          static_cast<std::uint16_t>(key.y + y),
                          static_cast<std::uint16_t>(key.z + z)};
    if (map.at(beside).state == VoxelState::occupied) return true;
  }
  return false;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 1.0;
}

}  // namespace

MapScore score_map(const UncertaintyMap& map, const UncertaintyMap& of_true_poses,
                   const Scene& scene) {
  MapScore score;
  std::uint64_t true_voxels = 0;
  for_each_occupied_voxel(map, [&](VoxelKey key, float uncertainty) {
    ++score.occupied_voxels;
    const double information = 1.0 - uncertainty;  // Equation (11)
    if (of_true_poses.at(key).state == VoxelState::occupied) {
      score.shared_information += information;
    }
    if (!scene.has_surface_within(map.lattice().centre_m(key),
                                  static_cast<float>(map.resolution_m()))) {
      return;
    }
    ++true_voxels;
    score.true_information += information;
  });
  score.precision = share(true_voxels, score.occupied_voxels);

  std::uint64_t seen = 0;
  std::uint64_t kept = 0;
  for_each_occupied_voxel(of_true_poses, [&](VoxelKey key, float) {
    ++seen;
    if (is_occupied_about(map, key)) ++kept;
  });
  score.recall = share(kept, seen);
  return score;
}

}  // namespace nbvopt
