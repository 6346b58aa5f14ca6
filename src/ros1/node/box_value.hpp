// What a box of the map holds, and what it could still bring.
#pragma once

#include <Eigen/Geometry>

#include "nbvopt/map/voxel_grid.hpp"

namespace nbvopt {

/// Sums over the voxels of a box.
struct BoxValue {
  double information = 0.0;   ///< Eq. 11: 1 - u of occupied voxels
  double uncertainty = 0.0;   ///< u of occupied voxels: what views of them could gain at most
  std::uint64_t unknown = 0;  ///< voxels
};

/// Larger boxes are refused.
inline constexpr double kMostBoxVoxels = 1e9;

/// The keys of a box in the map frame, metres. Throws InputError unless it is finite, not upside
/// down, on the lattice, and of at most kMostBoxVoxels.
KeyBox key_box(const Lattice& lattice, const Eigen::Vector3d& min_m, const Eigen::Vector3d& max_m);

/// Of a grid whose bricks were all read.
BoxValue box_value(const VoxelGrid& grid, const KeyBox& box, double occupied_uncertainty);

}  // namespace nbvopt
