// Maps as point clouds, for viewers.
#pragma once

#include <string>

#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

/// A binary .ply of the centres of occupied voxels, coloured by u. Throws InputError beyond
/// kMostMapPoints.
std::string ply_file(const UncertaintyMap& map, MapPoints points);

/// The same as a binary .pcd.
std::string pcd_file(const UncertaintyMap& map, MapPoints points);

}  // namespace nbvopt
