// The options that say how depth images are read.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <optional>
#include <string>

#include "nbvopt/map/depth_image.hpp"

namespace nbvopt {

struct DepthImageArguments {
  std::optional<std::array<double, 4>> fx_fy_cx_cy_px;
  std::optional<double> depth_scale_m;
  std::string largest_value;  ///< empty: the default
};

/// `fallback` tells what holds where an option is not given; empty: DepthImageOptions' defaults.
void add_depth_image_arguments(CLI::App& app, DepthImageArguments& arguments,
                               const std::string& fallback);

/// None without intrinsics.
std::optional<DepthImageOptions> depth_image_options(const DepthImageArguments& arguments);

}  // namespace nbvopt
