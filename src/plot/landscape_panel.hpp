// The gain over pan and tilt, as a map.
#pragma once

#include "plot/canvas.hpp"
#include "plot/plot_input.hpp"

namespace nbvopt {

/// Draws the landscape with the grid's candidates, what the search evaluated, its successive best
/// views, the start and the answer; axes, the scale of the gain and the legend lie outside the
/// panel: 60 points to its left, 90 to its right, 72 below.
void draw_landscape(Canvas& canvas, const Rectangle& panel, const PlotInput& input);

}  // namespace nbvopt
