// Where the points of a scan lie, before any map is asked.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "nbvopt/map/scan.hpp"

namespace nbvopt {

enum class PointPlace { in_range, too_near, too_far, not_finite };

/// The range of a point, as the sensor measures it.
inline double range_m(const Eigen::Vector3d& p_sensor_m, const SensorOptions& sensor) {
  return sensor.range_axis == RangeAxis::z_depth ? p_sensor_m.z() : p_sensor_m.norm();
}

/// Where a point lies; notes its range in `counts`, but does not count it.
inline PointPlace place_of(const Eigen::Vector3d& p_sensor_m, const SensorOptions& sensor,
                           ScanCounts& counts) {
  if (!p_sensor_m.allFinite()) return PointPlace::not_finite;
  const double range = range_m(p_sensor_m, sensor);
  if (range != 0.0) {  // a comparison with NaN, where there was no point yet, is false
    if (!(counts.nearest_m <= range)) counts.nearest_m = range;
    if (!(counts.farthest_m >= range)) counts.farthest_m = range;
  }
  if (!(range > sensor.range_min_m)) return PointPlace::too_near;
  return range < sensor.range_max_m ? PointPlace::in_range : PointPlace::too_far;
}

/// The count of the points that lie there.
inline std::uint64_t& count_of(PointPlace place, ScanCounts& counts) {
  switch (place) {
    case PointPlace::in_range:
      return counts.points_used;
    case PointPlace::too_near:
      return counts.points_too_near;
    case PointPlace::too_far:
      return counts.points_too_far;
    case PointPlace::not_finite:
      break;
  }
  return counts.points_not_finite;
}

/// Whether a direction without return leads anywhere.
inline bool is_direction(const Eigen::Vector3d& direction_sensor, const SensorOptions& sensor) {
  return direction_sensor.allFinite() && range_m(direction_sensor, sensor) > 0.0;
}

/// Throws InputError where every point lies so far away that the unit must be wrong.
void refuse_wrong_unit(const ScanCounts& counts, const SensorOptions& sensor);

}  // namespace nbvopt
