// A map from above, as the 2D navigation of ROS reads it: a picture and what it means.
#pragma once

#include <filesystem>
#include <limits>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// Heights in the map frame, metres. A voxel counts where its centre lies between them.
struct HeightBand {
  double min_m = -std::numeric_limits<double>::infinity();
  double max_m = std::numeric_limits<double>::infinity();
};

/// Writes the map projected onto its x, y plane as map_server and Nav2 read it: a grey picture
/// (.pgm), a pixel a voxel, x to the right and y up, and beside it what it means (.yaml). A column
/// of voxels is occupied (0) where any in the band is, else free (254) where any is, else unknown
/// (205). `path` is either of the two files; the other has the other extension. Each is written
/// whole or not at all.
///
/// Throws InputError when nothing is known in the band, when the band is upside down, beyond
/// 100 million pixels, and as write_map() does.
void write_floor_plan(const UncertaintyMap& map, const std::filesystem::path& path,
                      const HeightBand& band = {});

}  // namespace nbvopt
