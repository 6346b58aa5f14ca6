#include "map/scan_counting.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

/// No camera with this D_max sees nothing but what is so many times farther.
constexpr double kImplausible = 50.0;

/// "1000": at most four digits, for people.
std::string rounded(double length_m) {
  std::string text = decimal(length_m, length_m < 10.0 ? 3 : length_m < 100.0 ? 1 : 0);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// What such a scan usually is, where all its points are too near or too far.
std::string likely_cause(const ScanCounts& counts, const SensorOptions& sensor) {
  const auto in_range = [&sensor](double nearest_m, double farthest_m) {
    return nearest_m < sensor.range_max_m && farthest_m > sensor.range_min_m;
  };
  for (const auto& [factor, unit] : {std::pair{0.001, "millimetres"}, {0.01, "centimetres"}}) {
    if (in_range(counts.nearest_m * factor, counts.farthest_m * factor)) {
      return std::string("are they ") + unit + ", or is depth_scale_m wrong?";
    }
  }
  return counts.points_too_far > 0
             ? "is their unit metres, depth_scale_m right, and are they in the camera's frame, not "
               "in the map's?"
             : "is their unit metres, and depth_scale_m right?";
}

}  // namespace

void refuse_wrong_unit(const ScanCounts& counts, const SensorOptions& sensor) {
  if (counts.nearest_m > kImplausible * sensor.range_max_m) {
    throw InputError("scan: " + none_in_range(counts, sensor));
  }
}

ScanCounts count_scan(const Scan& scan, const SensorOptions& sensor) {
  ScanCounts counts;
  for (const Eigen::Vector3f& p_sensor_m : scan.points_m) {
    const PointPlace place = place_of(p_sensor_m.cast<double>(), sensor, counts);
    ++count_of(place, counts);
  }
  for (const Eigen::Vector3f& direction : scan.no_returns) {
    ++(is_direction(direction.cast<double>(), sensor) ? counts.no_returns
                                                      : counts.points_not_finite);
  }
  return counts;
}

std::string none_in_range(const ScanCounts& counts, const SensorOptions& sensor) {
  if (counts.points_used > 0) return "";
  const std::uint64_t too_near = counts.points_too_near;
  const std::uint64_t too_far = counts.points_too_far;
  if (std::isnan(counts.nearest_m) || too_near + too_far == 0) {
    if (counts.points_off_lattice > 0) {
      return "every point lies off the map's lattice: are unit and pose right?";
    }
    if (counts.no_returns > 0) {
      return "no point, only directions without a return: does the largest value mean that "
             "nothing is in range, or that a pixel is not known?";
    }
    if (too_near > 0) return "every point is the origin: the camera gave no data";
    return counts.points_not_finite > 0 ? "no point is finite: the camera gave no data"
                                        : "it holds no points";
  }
  std::string text = "no point is between " + rounded(sensor.range_min_m) + " and " +
                     rounded(sensor.range_max_m) + " m away: " + std::to_string(too_near) +
                     " nearer, " + std::to_string(too_far) + " farther, from " +
                     rounded(counts.nearest_m) + " to " + rounded(counts.farthest_m) + " m; ";
  return text + likely_cause(counts, sensor);
}

}  // namespace nbvopt
