// Declaring a box of a map to be free.
#pragma once

#include <vector>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// What became free.
struct BoxClearing {
  std::vector<VoxelChange> changes;  ///< voxels that were occupied
  std::vector<VoxelKey> tiles;       ///< that were written: cubes of 64^3 voxels, least keys
};

/// More known voxels are not cleared at once.
inline constexpr std::uint64_t kMostClearedVoxels = 20'000'000;

/// Makes the known voxels of the box free, as surely as OctoMap's limits allow; what is unknown
/// stays so. Throws InputError beyond kMostClearedVoxels; the map is then untouched.
BoxClearing clear_box(UncertaintyMap& map, const KeyBox& box);

}  // namespace nbvopt
