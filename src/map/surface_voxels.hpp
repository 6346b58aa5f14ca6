// The voxels that can be seen of what is occupied.
#pragma once

#include <cstdint>
#include <functional>

#include "map/uncertainty_octree.hpp"

namespace nbvopt {

/// Calls visit(voxel, its leaf) once for each occupied voxel with a face to a voxel that is not
/// occupied, or to the lattice's end, until it returns false. Of a big leaf only the faces are
/// looked at, and of those only where the neighbour is not as big and occupied.
void for_each_surface_voxel(
    const UncertaintyOcTree& tree,
    const std::function<bool(VoxelKey voxel, const UncertaintyOcTreeNode& leaf)>& visit);

}  // namespace nbvopt
