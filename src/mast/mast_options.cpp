#include <cmath>
#include <numbers>
#include <utility>

#include "core/field_check.hpp"
#include "nbvopt/mast/mast.hpp"

namespace nbvopt {
namespace {

void check_limits(std::string_view min_field, double min, const std::string& max_field,
                  double max) {
  check_field(true, max_field, max, "a finite number");
  check_field(min <= max, min_field, min,
              "at most " + max_field + ", which is " + format_number(max));
}

void check_velocity(std::string_view field, double value) {
  check_field(value > 0.0, field, value, "greater than 0 (equal limits freeze a joint)");
}

}  // namespace

void MastOptions::validate() const {
  constexpr double kMaxHeightM = 100.0;  // a slip of the unit lies beyond it
  constexpr double kRightAngle = 0.5 * std::numbers::pi;
  check_limits("mast.pan_min_rad", pan_min_rad, "mast.pan_max_rad", pan_max_rad);
  check_velocity("mast.pan_velocity_rad_s", pan_velocity_rad_s);
  check_limits("mast.tilt_min_rad", tilt_min_rad, "mast.tilt_max_rad", tilt_max_rad);
  check_field(tilt_min_rad >= -kRightAngle, "mast.tilt_min_rad", tilt_min_rad,
              "at least -pi/2 rad");
  check_field(tilt_max_rad <= kRightAngle, "mast.tilt_max_rad", tilt_max_rad, "at most pi/2 rad");
  check_velocity("mast.tilt_velocity_rad_s", tilt_velocity_rad_s);
  check_limits("mast.height_min_m", height_min_m, "mast.height_max_m", height_max_m);
  check_field(height_min_m >= -kMaxHeightM, "mast.height_min_m", height_min_m, "at least -100 m");
  check_field(height_max_m <= kMaxHeightM, "mast.height_max_m", height_max_m, "at most 100 m");
  check_velocity("mast.height_velocity_m_s", height_velocity_m_s);
  for (const auto& [field, value] : {std::pair{"mast.pan_axis_x_m", pan_axis_x_m},
                                     std::pair{"mast.pan_axis_y_m", pan_axis_y_m}}) {
    check_field(std::abs(value) <= kMaxHeightM, field, value, "within 100 m of 0");
  }
  for (const double coordinate : sensor_offset_m) {
    check_field(true, "mast.sensor_offset_m", coordinate, "three finite numbers");
  }
}

}  // namespace nbvopt
