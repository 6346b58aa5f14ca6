#include "map/scan_rays.hpp"

#include "map/scan_counting.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

class RayCollector {
 public:
  RayCollector(const Transform& T_map_sensor, const SensorOptions& sensor, const Lattice& lattice)
      : T_map_sensor_(T_map_sensor), sensor_(sensor), lattice_(lattice) {
    if (!T_map_sensor.matrix().allFinite()) {
      throw InputError("scan pose: every number must be finite");
    }
    if (!lattice.contains(T_map_sensor.translation())) {
      throw InputError("scan pose: the position lies outside the map's lattice, check its unit");
    }
    rays_.origin = lattice.to_lattice(T_map_sensor.translation());
  }

  void reserve(std::size_t rays) {
    rays_.ends.reserve(rays);
    rays_.hits.reserve(rays);
  }

  void add_point(const Eigen::Vector3d& p_sensor_m, std::uint32_t point) {
    const PointPlace place = place_of(p_sensor_m, sensor_, rays_.counts);
    const bool is_off_lattice = (place == PointPlace::in_range && !add_hit(p_sensor_m, point)) ||
                                (place == PointPlace::too_far && !add_clear_ray(p_sensor_m));
    ++(is_off_lattice ? rays_.counts.points_off_lattice : count_of(place, rays_.counts));
  }

  void add_no_return(const Eigen::Vector3d& direction_sensor) {
    if (!is_direction(direction_sensor, sensor_)) {
      ++rays_.counts.points_not_finite;
    } else {
      ++(add_clear_ray(direction_sensor) ? rays_.counts.no_returns
                                         : rays_.counts.points_off_lattice);
    }
  }

  ScanRays take() && { return std::move(rays_); }

 private:
  /// The ray in this direction, of any length, is clear up to D_max. False where that end is off
  /// the lattice.
  bool add_clear_ray(const Eigen::Vector3d& direction_sensor) {
    if (sensor_.no_return == NoReturn::ignore) return true;
    const double length = range_m(direction_sensor, sensor_);
    const Eigen::Vector3d end_map_m =
        T_map_sensor_ * (direction_sensor * (sensor_.range_max_m / length));
    if (!add_end(lattice_.to_lattice(end_map_m))) return false;
    ++rays_.cleared;
    return true;
  }

  /// False for a point off the lattice.
  bool add_hit(const Eigen::Vector3d& p_sensor_m, std::uint32_t point) {
    const Eigen::Vector3d end = lattice_.to_lattice(T_map_sensor_ * p_sensor_m);
    if (!add_end(end)) return false;
    const Eigen::Vector3i voxel = end.cast<int>();
    rays_.hits.push_back(
        {{static_cast<std::uint16_t>(voxel.x()), static_cast<std::uint16_t>(voxel.y()),
          static_cast<std::uint16_t>(voxel.z())},
         point});
    return true;
  }

  /// False for an end off the lattice.
  bool add_end(const Eigen::Vector3d& end) {
    if (!Lattice::holds(end)) return false;
    rays_.ends.add(end);
    return true;
  }

  const Transform& T_map_sensor_;
  const SensorOptions& sensor_;
  const Lattice& lattice_;
  ScanRays rays_;
};

}  // namespace

ScanRays scan_rays(const Scan& scan, const Transform& T_map_sensor, const SensorOptions& sensor,
                   const Lattice& lattice) {
  RayCollector collector(T_map_sensor, sensor, lattice);
  collector.reserve(scan.points_m.size() + scan.no_returns.size());
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    collector.add_point(scan.points_m[i].cast<double>(), static_cast<std::uint32_t>(i));
  }
  for (const Eigen::Vector3f& direction : scan.no_returns) {
    collector.add_no_return(direction.cast<double>());
  }
  return std::move(collector).take();
}

}  // namespace nbvopt
