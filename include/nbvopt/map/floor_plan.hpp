// A map from above, as the 2D navigation of ROS reads it: a picture and what it means.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "nbvopt/map/uncertainty_map.hpp"

namespace nbvopt {

/// Heights in the map frame, metres. A voxel counts where its centre lies between them.
struct HeightBand {
  double min_m = -std::numeric_limits<double>::infinity();
  double max_m = std::numeric_limits<double>::infinity();
};

/// The map projected onto its x, y plane: a pixel a column of voxels, x to the right, the first row
/// at the largest y. A column is occupied where any voxel in the band is, else free where any is,
/// else unknown.
struct FloorPlan {
  static constexpr char kOccupied = 0;
  static constexpr char kFree = static_cast<char>(254);
  static constexpr char kUnknown = static_cast<char>(205);

  int width = 0, height = 0;
  double resolution_m = 0.0;
  double x_m = 0.0, y_m = 0.0;  ///< of the corner with the least coordinates, in the map
  std::string pixels;           ///< width * height, row by row
};

/// None where nothing is known in the band. Throws InputError when the band is upside down, and
/// beyond 100 million pixels.
std::optional<FloorPlan> floor_plan(const UncertaintyMap& map, const HeightBand& band = {});

/// Writes the map projected onto its x, y plane as map_server and Nav2 read it: a grey picture
/// (.pgm) as in FloorPlan, and beside it what it means (.yaml). `path` is either of the two files;
/// the other has the other extension. Each is written whole or not at all.
///
/// Throws InputError when nothing is known in the band, and as floor_plan() and write_map() do.
void write_floor_plan(const UncertaintyMap& map, const std::filesystem::path& path,
                      const HeightBand& band = {});

}  // namespace nbvopt
