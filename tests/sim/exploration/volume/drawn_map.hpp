// Maps of 0.05 m drawn by hand.
#pragma once

#include <string>
#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt::test {

inline void set_state(UncertaintyMap& map, VoxelKey key, VoxelState state) {
  if (state == VoxelState::unknown) return;
  map.set(key, {.state = state, .log_odds = state == VoxelState::occupied ? 1.0F : -1.0F});
}

/// The voxel so many from the map's origin.
inline VoxelKey key_at(int x, int y, int z) {
  const auto key = [](int voxel) {
    return static_cast<std::uint16_t>(Lattice::kKeyOfOrigin + voxel);
  };
  return {key(x), key(y), key(z)};
}

/// A layer of voxels as seen from above, the row of the greatest y first: '.' free, '#' occupied,
/// anything else unknown. Its least corner is the map's origin.
inline UncertaintyMap drawn_layer(const std::vector<std::string>& rows, int z) {
  UncertaintyMap map(0.05);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const int y = static_cast<int>(rows.size() - 1 - row);
    for (std::size_t x = 0; x < rows[row].size(); ++x) {
      const char c = rows[row][x];
      set_state(map, key_at(static_cast<int>(x), y, z),
                c == '.'   ? VoxelState::free
                : c == '#' ? VoxelState::occupied
                           : VoxelState::unknown);
    }
  }
  map.finish_writing();
  return map;
}

}  // namespace nbvopt::test
