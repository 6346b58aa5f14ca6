// The picture of an answer: what the robot knows around it, where its camera looks and should
// look, what other pan and tilt angles would have gained, and how the search went.
#pragma once

#include <filesystem>
#include <string>

#include "plot/plot_input.hpp"

namespace nbvopt {

/// Draws the picture: the bytes of a PNG file.
std::string plot_png(const PlotInput& input);

/// The same as a file, whole or not at all. Throws InputError when it cannot be written.
void write_plot(const PlotInput& input, const std::filesystem::path& path);

}  // namespace nbvopt
