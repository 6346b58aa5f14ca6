// Depth images: how their pixels become points of a scan.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// What 65535, the largest value of a pixel, means.
enum class LargestValue {
  no_return,  ///< nothing is in range: the ray is clear
  invalid,    ///< the pixel is not known, as 0
  far,        ///< the depth that it is
};
std::string to_string(LargestValue value);

/// How to turn a depth image's pixels into points. The centre of the top left pixel is (0, 0); the
/// ray through pixel (u, v) is ((u - cx) / fx, (v - cy) / fy, 1).
struct DepthImageOptions {
  double fx_px = std::numeric_limits<double>::quiet_NaN();
  double fy_px = std::numeric_limits<double>::quiet_NaN();  ///< negative: rows run upwards
  double cx_px = std::numeric_limits<double>::quiet_NaN();
  double cy_px = std::numeric_limits<double>::quiet_NaN();
  double depth_scale_m = 0.001;  ///< metres along the optical axis a unit of the image
  LargestValue largest_value = LargestValue::no_return;

  bool operator==(const DepthImageOptions&) const = default;

  /// Throws InputError that names the first bad field with its value.
  void validate() const;
};

/// Adds a row of 16-bit depths, from the left, to the scan. 0 means that the pixel is not known, as
/// drivers have it.
void append_depth_row(std::span<const std::uint16_t> depths, std::uint32_t row,
                      const DepthImageOptions& options, Scan& scan);

}  // namespace nbvopt
