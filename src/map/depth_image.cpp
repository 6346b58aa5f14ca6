#include "nbvopt/map/depth_image.hpp"

#include <string>

#include "core/field_check.hpp"

namespace nbvopt {

namespace {

void check_positive(const std::string& field, double value) {
  check_field(value > 0.0, "depth image: " + field, value, "positive and finite");
}

void check_finite(const std::string& field, double value) {
  check_field(true, "depth image: " + field, value, "finite");
}

}  // namespace

void DepthImageOptions::validate() const {
  check_positive("fx_px", fx_px);
  check_positive("fy_px", fy_px);
  check_finite("cx_px", cx_px);
  check_finite("cy_px", cy_px);
  check_positive("depth_scale_m", depth_scale_m);
}

void append_depth_row(std::span<const std::uint16_t> depths, std::uint32_t row,
                      const DepthImageOptions& options, Scan& scan) {
  constexpr std::uint16_t kNotKnown = 0;
  constexpr std::uint16_t kNothingInRange = 65535;
  for (std::size_t column = 0; column < depths.size(); ++column) {
    const std::uint16_t depth = depths[column];
    if (depth == kNotKnown) continue;
    const Eigen::Vector3d direction((static_cast<double>(column) - options.cx_px) / options.fx_px,
                                    (row - options.cy_px) / options.fy_px, 1.0);
    if (depth == kNothingInRange) {
      scan.no_returns.push_back(direction.cast<float>());
    } else {
      scan.points_m.push_back((direction * (depth * options.depth_scale_m)).cast<float>());
    }
  }
}

}  // namespace nbvopt
