// Where the points of a scan lie, before any map is asked.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "nbvopt/map/scan.hpp"

namespace nbvopt {

enum class PointPlace { in_range, too_near, too_far, not_finite };

/// The range of a point, as the sensor measures it.
double range_m(const Eigen::Vector3d& p_sensor_m, const SensorOptions& sensor);

/// Where a point lies; notes its range in `counts`, but does not count it.
PointPlace place_of(const Eigen::Vector3d& p_sensor_m, const SensorOptions& sensor,
                    ScanCounts& counts);

/// The count of the points that lie there.
std::uint64_t& count_of(PointPlace place, ScanCounts& counts);

/// Whether a direction without return leads anywhere.
bool is_direction(const Eigen::Vector3d& direction_sensor, const SensorOptions& sensor);

/// Throws InputError where every point lies so far away that the unit must be wrong.
void refuse_wrong_unit(const ScanCounts& counts, const SensorOptions& sensor);

}  // namespace nbvopt
