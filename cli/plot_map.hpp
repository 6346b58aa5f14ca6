// The map around the robot from above, with the views on it.
#pragma once

#include "cli/canvas.hpp"
#include "cli/plot.hpp"

namespace nbvopt {

/// The heights that the top view shows, in the map frame: a column is occupied when any voxel
/// between them is. Otherwise it is what it is at the camera's height.
struct MapSlice {
  double z_min_m = 0.0;
  double z_camera_m = 0.0;
  double z_max_m = 0.0;
};

/// From just above the ground to just above the highest camera.
MapSlice map_slice(const PlotInput& input);

/// Draws the square of the map that the camera can see into, axes included, on the panel.
void draw_map(Canvas& canvas, const Rectangle& panel, const PlotInput& input,
              const MapSlice& slice);

}  // namespace nbvopt
