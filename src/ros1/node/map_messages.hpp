// The map as the messages that viewers and navigation take. They have no stamp and no frame yet.
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <octomap_msgs/Octomap.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "nbvopt/map/floor_plan.hpp"
#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// A message of a map's file: a .bt where it is binary, else an .ot of type UncertaintyOcTree.
octomap_msgs::Octomap octomap_message(const std::string& file, bool is_binary, double resolution_m);

/// Cubes, a list of them for each size of the octree's nodes: id 16 has those of one voxel. Lists
/// without a cube delete what was there.
///
/// Of the occupied voxels in the band those that can be seen, coloured by u: red 1, green 0.
visualization_msgs::MarkerArray occupied_cells(const UncertaintyMap& map, const HeightBand& band);
/// Free nodes, each in its size.
visualization_msgs::MarkerArray free_cells(const UncertaintyMap& map);

/// The centres of the voxels of occupied_cells() with their colours: x, y, z, rgb.
sensor_msgs::PointCloud2 voxel_centres(const UncertaintyMap& map, const HeightBand& band);

/// The map from above: 100 occupied, 0 free, -1 unknown. Empty where nothing is known in the band.
nav_msgs::OccupancyGrid projected_map(const UncertaintyMap& map, const HeightBand& band);

}  // namespace nbvopt
