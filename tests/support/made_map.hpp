// Maps made by hand, and maps made by chance.
#pragma once

#include <cstdint>
#include <random>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt::test {

inline constexpr VoxelRecord kFree{.state = VoxelState::free, .log_odds = -1.0F};

inline VoxelRecord occupied(float uncertainty) {
  return {.state = VoxelState::occupied, .log_odds = 2.0F, .uncertainty = uncertainty};
}

inline VoxelKey key_at(int x, int y, int z) {
  return {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
          static_cast<std::uint16_t>(z)};
}

/// A key counted from the voxel that starts at the map's origin.
inline VoxelKey key_from_origin(int x, int y, int z) {
  return key_at(Lattice::kKeyOfOrigin + x, Lattice::kKeyOfOrigin + y, Lattice::kKeyOfOrigin + z);
}

/// The cube of `size` voxels an axis from `least` on.
inline KeyBox cube(VoxelKey least, int size) {
  return {least, key_at(least.x + size - 1, least.y + size - 1, least.z + size - 1)};
}

template <typename Visit>
void for_each_key(const KeyBox& box, Visit&& visit) {
  for (int z = box.min.z; z <= box.max.z; ++z) {
    for (int y = box.min.y; y <= box.max.y; ++y) {
      for (int x = box.min.x; x <= box.max.x; ++x) visit(key_at(x, y, z));
    }
  }
}

inline void set_box(UncertaintyMap& map, const KeyBox& box, const VoxelRecord& record) {
  for_each_key(box, [&](VoxelKey key) { map.set(key, record); });
}

/// The voxels whose centres lie between two corners.
inline KeyBox keys_between(const Lattice& lattice, const Eigen::Vector3d& min_m,
                           const Eigen::Vector3d& max_m) {
  const Eigen::Vector3d half_voxel_m = Eigen::Vector3d::Constant(0.5 * lattice.resolution_m());
  return {lattice.key(min_m + half_voxel_m), lattice.key(max_m - half_voxel_m)};
}

/// Uniform in [0, 1), the same with every standard library.
inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

inline double uniform(std::mt19937_64& random, double min, double max) {
  return min + (max - min) * uniform(random);
}

/// Uniform in [min, max].
inline int uniform_int(std::mt19937_64& random, int min, int max) {
  return min + static_cast<int>(random() % static_cast<std::uint64_t>(max - min + 1));
}

/// A free voxel, or, with the chance `clutter`, an occupied one of some u or none at all.
inline VoxelRecord random_voxel(std::mt19937_64& random, double clutter) {
  const double draw = uniform(random);
  if (draw >= clutter) return kFree;
  if (draw < 0.5 * clutter) return {};
  return occupied(static_cast<float>(uniform_int(random, 0, 64)) / 64.0F);
}

/// Fills the box with random voxels.
inline void scatter(UncertaintyMap& map, const KeyBox& box, double clutter,
                    std::mt19937_64& random) {
  for_each_key(box, [&](VoxelKey key) {
    const VoxelRecord record = random_voxel(random, clutter);
    if (record.state != VoxelState::unknown) map.set(key, record);
  });
}

}  // namespace nbvopt::test
