// Depth images: how their pixels become points of a scan.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// How to turn a depth image's pixels into points. The centre of the top left pixel is (0, 0).
struct DepthImageOptions {
  double fx_px = std::numeric_limits<double>::quiet_NaN();
  double fy_px = std::numeric_limits<double>::quiet_NaN();
  double cx_px = std::numeric_limits<double>::quiet_NaN();
  double cy_px = std::numeric_limits<double>::quiet_NaN();
  double depth_scale_m = 0.001;  ///< metres along the optical axis a unit of the image

  /// Throws InputError that names the first bad field with its value.
  void validate() const;
};

/// Adds a row of 16-bit depths, from the left, to the scan. 0 means that the pixel is not known, as
/// drivers have it; 65535, the largest value, that nothing is in range.
void append_depth_row(std::span<const std::uint16_t> depths, std::uint32_t row,
                      const DepthImageOptions& options, Scan& scan);

}  // namespace nbvopt
