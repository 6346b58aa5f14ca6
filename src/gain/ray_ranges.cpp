#include "gain/ray_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace nbvopt::detail {
namespace {

/// Of directions, cells: they are kept in single precision.
constexpr float kCellRounding = 2e-3F;

int cell_of(double place) { return static_cast<int>(std::floor(place)); }

}  // namespace

RayRanges::RayRanges(const CameraRays& rays, double tilt_min_rad, double tilt_max_rad,
                     double cell_rad) {
  constexpr double kHalfPi = 0.5 * std::numbers::pi;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    // A ray turns with the tilt in a plane of constant x: by an angle from the horizon.
    const double x = rays.x[i] / rays.z[i];
    const double y = rays.y[i] / rays.z[i];
    const double ahead = std::hypot(1.0, y);
    const double low = tilt_min_rad - std::atan(y);
    const double high = tilt_max_rad - std::atan(y);
    const auto elevation = [&](double turn) {
      return std::atan2(ahead * std::sin(turn), std::hypot(x, ahead * std::cos(turn)));
    };
    const auto azimuth = [&](double turn) { return std::atan2(-x, ahead * std::cos(turn)); };
    double elevation_min_rad = std::min(elevation(low), elevation(high));
    double elevation_max_rad = std::max(elevation(low), elevation(high));
    double azimuth_min_rad = std::min(azimuth(low), azimuth(high));
    double azimuth_max_rad = std::max(azimuth(low), azimuth(high));
    if (low < 0.0 && high > 0.0) {  // |azimuth| is least at the horizon
      azimuth_min_rad = std::min(azimuth_min_rad, azimuth(0.0));
      azimuth_max_rad = std::max(azimuth_max_rad, azimuth(0.0));
    }
    constexpr double kBesidePole_rad = 1e-3;
    if (high > kHalfPi - kBesidePole_rad || low < -kHalfPi + kBesidePole_rad) {
      if (high > kHalfPi - kBesidePole_rad) elevation_max_rad = elevation(kHalfPi);
      if (low < -kHalfPi + kBesidePole_rad) elevation_min_rad = elevation(-kHalfPi);
      azimuth_min_rad = -std::numbers::pi;
      azimuth_max_rad = std::numbers::pi;
    }
    azimuth_min.push_back(static_cast<float>(azimuth_min_rad / cell_rad) - kCellRounding);
    azimuth_max.push_back(static_cast<float>(azimuth_max_rad / cell_rad) + kCellRounding);
    elevation_min.push_back(static_cast<float>(elevation_min_rad / cell_rad) - kCellRounding);
    elevation_max.push_back(static_cast<float>(elevation_max_rad / cell_rad) + kCellRounding);
  }
  const auto least = [](const std::vector<float>& v) {
    return *std::min_element(v.begin(), v.end());
  };
  const auto largest = [](const std::vector<float>& v) {
    return *std::max_element(v.begin(), v.end());
  };
  least_azimuth = least(azimuth_min);
  largest_azimuth = largest(azimuth_max);
  least_elevation = least(elevation_min);
  largest_elevation = largest(elevation_max);
}

CellBox seen_from(const RayRanges& ranges, int pan_begin, int pan_end,
                  const std::pair<double, double>& turn_cells) {
  return {.azimuth_min = pan_begin + cell_of(ranges.least_azimuth + turn_cells.first) - 1,
          .azimuth_max = pan_end + cell_of(ranges.largest_azimuth + turn_cells.second) + 2,
          .elevation_min = cell_of(ranges.least_elevation) - 1,
          .elevation_max = cell_of(ranges.largest_elevation) + 2};
}

RayWindows windows_of(const RayRanges& ranges, const std::pair<double, double>& turn_cells,
                      const CellBox& cells, const std::vector<float>& angle_part) {
  RayWindows windows;
  windows.offset.reserve(2 * angle_part.size());
  windows.end.reserve(angle_part.size());
  windows.angle_part = angle_part;
  const auto turn_min = static_cast<float>(turn_cells.first) - kCellRounding;
  const auto turn_max = static_cast<float>(turn_cells.second) + kCellRounding;
  for (std::size_t i = 0; i < angle_part.size(); ++i) {
    const int left = cell_of(ranges.azimuth_min[i] + turn_min);
    const int right = cell_of(1.0F + ranges.azimuth_max[i] + turn_max);
    const int below = cell_of(ranges.elevation_min[i]);
    const int above = cell_of(ranges.elevation_max[i]);
    for (int y = below;; y = std::min(y + 2, above - 1)) {
      for (int x = left;; x = std::min(x + 2, right - 1)) {
        windows.offset.push_back((y - cells.elevation_min) * cells.wide() + x - cells.azimuth_min);
        if (x + 2 > right) break;
      }
      if (y + 2 > above) break;
    }
    windows.end.push_back(static_cast<std::int32_t>(windows.offset.size()));
  }
  return windows;
}

}  // namespace nbvopt::detail
