#include "nbvopt/map/depth_image.hpp"

#include <string>

#include "core/field_check.hpp"
#include "map/scan_names.hpp"

namespace nbvopt {

namespace {

void check_focal_length(const std::string& field, double value) {
  check_field(value != 0.0, "depth image: " + field, value, "finite and not 0");
}

void check_finite(const std::string& field, double value) {
  check_field(true, "depth image: " + field, value, "finite");
}

}  // namespace

std::string to_string(LargestValue value) { return std::string(enum_name(value)); }

void DepthImageOptions::validate() const {
  check_focal_length("fx_px", fx_px);
  check_focal_length("fy_px", fy_px);
  check_finite("cx_px", cx_px);
  check_finite("cy_px", cy_px);
  check_field(depth_scale_m > 0.0, "depth image: depth_scale_m", depth_scale_m,
              "positive and finite");
}

void append_depth_row(std::span<const std::uint16_t> depths, std::uint32_t row,
                      const DepthImageOptions& options, Scan& scan) {
  constexpr std::uint16_t kNotKnown = 0;
  constexpr std::uint16_t kLargest = 65535;
  for (std::size_t column = 0; column < depths.size(); ++column) {
    const std::uint16_t depth = depths[column];
    const bool is_largest = depth == kLargest;
    if (depth == kNotKnown || (is_largest && options.largest_value == LargestValue::invalid)) {
      continue;
    }
    const Eigen::Vector3d direction((static_cast<double>(column) - options.cx_px) / options.fx_px,
                                    (row - options.cy_px) / options.fy_px, 1.0);
    if (is_largest && options.largest_value == LargestValue::no_return) {
      scan.no_returns.push_back(direction.cast<float>());
    } else {
      scan.points_m.push_back((direction * (depth * options.depth_scale_m)).cast<float>());
    }
  }
}

}  // namespace nbvopt
