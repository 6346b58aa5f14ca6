// The map around the robot from above, with the views on it.
#pragma once

#include "plot/canvas.hpp"
#include "plot/plot_input.hpp"
#include "plot/top_view.hpp"

namespace nbvopt {

/// From just above the ground to just above the highest camera.
MapSlice map_slice(const PlotInput& input);

/// Draws the square of the map that the camera can see into, axes included, on the panel.
void draw_map(Canvas& canvas, const Rectangle& panel, const PlotInput& input,
              const MapSlice& slice);

}  // namespace nbvopt
