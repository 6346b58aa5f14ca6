#include "nbvopt/sensor/sensor_options.hpp"

#include <cmath>
#include <numbers>

#include "core/field_check.hpp"
#include "nbvopt/core/error.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

constexpr double kMaxRangeM = 1000.0;
/// A side of 16384 and 4 million in all: what fits in memory with room to spare.
constexpr int kMaxSide = 16384;
constexpr double kMaxImage = 4194304.0;

void check_half_angle(std::string_view field, double value_rad) {
  check_field(value_rad > 0.0 && value_rad < 0.5 * std::numbers::pi, field, value_rad,
              "greater than 0 and less than pi/2 rad");
}

void check_image(std::string_view horizontal, std::string_view vertical, int width, int height) {
  check_field(width >= 1 && width <= kMaxSide, horizontal, width, "1 to 16384");
  check_field(height >= 1 && height <= kMaxSide, vertical, height, "1 to 16384");
  check_field(double{1} * width * height <= kMaxImage, horizontal, width,
              "smaller: the whole image may hold 4194304");
}

}  // namespace

double SensorOptions::longest_range_m() const {
  if (range_axis == RangeAxis::euclidean) return range_max_m;
  const double tan_h = std::tan(half_fov_horizontal_rad);
  const double tan_v = std::tan(half_fov_vertical_rad);
  return range_max_m * std::sqrt(1.0 + tan_h * tan_h + tan_v * tan_v);
}

void SensorOptions::validate() const {
  check_half_angle("sensor.half_fov_horizontal_rad", half_fov_horizontal_rad);
  check_half_angle("sensor.half_fov_vertical_rad", half_fov_vertical_rad);
  check_image("sensor.horizontal_rays", "sensor.vertical_rays", horizontal_rays, vertical_rays);
  check_image("sensor.horizontal_pixels", "sensor.vertical_pixels", horizontal_pixels,
              vertical_pixels);
  check_field(range_min_m >= 0.0, "sensor.range_min_m", range_min_m, "0 m or more");
  check_field(range_max_m <= kMaxRangeM, "sensor.range_max_m", range_max_m, "at most 1000 m");
  check_field(range_min_m < range_max_m, "sensor.range_min_m", range_min_m,
              "less than range_max_m, which is " + format_number(range_max_m));
  check_field(focal_distance_m >= 0.0, "sensor.focal_distance_m", focal_distance_m, "0 m or more");
  check_field(uncertainty_half_fov_horizontal_rad >= 0.0,
              "sensor.uncertainty_half_fov_horizontal_rad", uncertainty_half_fov_horizontal_rad,
              "0 rad (the half field of view) or more");
  check_field(uncertainty_half_fov_vertical_rad >= 0.0, "sensor.uncertainty_half_fov_vertical_rad",
              uncertainty_half_fov_vertical_rad, "0 rad (the half field of view) or more");
  check_field(normal_weight >= 0.0 && normal_weight < 1.0, "sensor.normal_weight", normal_weight,
              "from 0 to less than 1");
  if (!gain.is_of_paper() && counting == Counting::per_voxel) {
    throw InputError("sensor.counting is per_voxel, gain " + to_string(gain) +
                     " is a sum over rays: set it to per_ray");
  }
  check_field(occupied_uncertainty >= 0.0 && occupied_uncertainty <= 1.0,
              "sensor.occupied_uncertainty", occupied_uncertainty, "from 0 to 1");
}

std::string to_string(RayPattern value) { return std::string(enum_name(value)); }

std::string to_string(RangeAxis value) { return std::string(enum_name(value)); }

std::string to_string(UncertaintyMode value) { return std::string(enum_name(value)); }

std::string to_string(Counting value) { return std::string(enum_name(value)); }

std::string to_string(Visibility value) { return std::string(enum_name(value)); }

std::string to_string(NoReturn value) { return std::string(enum_name(value)); }

}  // namespace nbvopt
