// The gain against pan.
#pragma once

#include "plot/canvas.hpp"
#include "plot/plot_input.hpp"

namespace nbvopt {

/// Draws the gain of every reachable pan at the answer's tilt and height, split into what comes
/// from unknown and from badly seen voxels, with the current view, the answer and the candidates
/// marked; axes lie outside the panel.
void draw_gain(Canvas& canvas, const Rectangle& panel, const PlotInput& input);

}  // namespace nbvopt
