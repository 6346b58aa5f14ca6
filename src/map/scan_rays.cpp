#include "map/scan_rays.hpp"

#include "nbvopt/core/error.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"

namespace nbvopt {

namespace {

class RayCollector {
 public:
  RayCollector(const Transform& T_map_sensor, const SensorOptions& sensor, const Lattice& lattice)
      : T_map_sensor_(T_map_sensor), sensor_(sensor), model_(sensor), lattice_(lattice) {
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
    const double range_m = range(p_sensor_m);
    if (!(range_m > sensor_.range_min_m) || !p_sensor_m.allFinite()) {
      ++rays_.ignored;
    } else if (range_m < sensor_.range_max_m) {
      add_hit(p_sensor_m, point);
    } else {
      add_clear_ray(p_sensor_m);
    }
  }

  /// The ray in this direction, of any length, is clear up to D_max.
  void add_clear_ray(const Eigen::Vector3d& direction_sensor) {
    if (sensor_.no_return == NoReturn::ignore) return;
    const double length = range(direction_sensor);
    const Eigen::Vector3d end_map_m =
        T_map_sensor_ * (direction_sensor * (sensor_.range_max_m / length));
    if (!(length > 0.0) || !lattice_.contains(end_map_m)) {
      ++rays_.ignored;
      return;
    }
    rays_.ends.push_back(lattice_.to_lattice(end_map_m));
    ++rays_.cleared;
  }

  ScanRays take() && { return std::move(rays_); }

 private:
  double range(const Eigen::Vector3d& p_sensor_m) const {
    return sensor_.range_axis == RangeAxis::z_depth ? p_sensor_m.z() : p_sensor_m.norm();
  }

  void add_hit(const Eigen::Vector3d& p_sensor_m, std::uint32_t point) {
    const Eigen::Vector3d p_map_m = T_map_sensor_ * p_sensor_m;
    if (!lattice_.contains(p_map_m)) {
      ++rays_.ignored;
      return;
    }
    rays_.ends.push_back(lattice_.to_lattice(p_map_m));
    rays_.hits.push_back(
        {lattice_.key(p_map_m), static_cast<float>(model_.uncertainty(p_sensor_m)), point});
  }

  const Transform& T_map_sensor_;
  const SensorOptions& sensor_;
  UncertaintyModel model_;
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
    collector.add_clear_ray(direction.cast<double>());
  }
  return std::move(collector).take();
}

}  // namespace nbvopt
