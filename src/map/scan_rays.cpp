#include "map/scan_rays.hpp"

#include "map/scan_counting.hpp"
#include "map/scan_normals.hpp"
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

  /// Of all points, in the sensor frame; none where they do not count.
  void set_normals(std::vector<Eigen::Vector3f> normals) { normals_ = std::move(normals); }

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
    if (!lattice_.contains(end_map_m)) return false;
    rays_.ends.push_back(lattice_.to_lattice(end_map_m));
    ++rays_.cleared;
    return true;
  }

  /// False for a point off the lattice.
  bool add_hit(const Eigen::Vector3d& p_sensor_m, std::uint32_t point) {
    const Eigen::Vector3d p_map_m = T_map_sensor_ * p_sensor_m;
    if (!lattice_.contains(p_map_m)) return false;
    rays_.ends.push_back(lattice_.to_lattice(p_map_m));
    const VoxelKey key = lattice_.key(p_map_m);
    const double u = normals_.empty() ? model_.uncertainty(p_sensor_m)
                                      : model_.uncertainty(p_sensor_m, normal_sensor(point, key));
    rays_.hits.push_back({key, static_cast<float>(u), point});
    return true;
  }

  /// That of the last point added, or of the face by which its ray enters the voxel.
  Eigen::Vector3d normal_sensor(std::uint32_t point, VoxelKey voxel) const {
    if (!normals_[point].isZero()) return normals_[point].cast<double>();
    return T_map_sensor_.linear().transpose() *
           entered_face_normal(rays_.origin, rays_.ends.back(), voxel);
  }

  const Transform& T_map_sensor_;
  const SensorOptions& sensor_;
  UncertaintyModel model_;
  const Lattice& lattice_;
  std::vector<Eigen::Vector3f> normals_;
  ScanRays rays_;
};

}  // namespace

ScanRays scan_rays(const Scan& scan, const Transform& T_map_sensor, const SensorOptions& sensor,
                   const Lattice& lattice) {
  RayCollector collector(T_map_sensor, sensor, lattice);
  collector.reserve(scan.points_m.size() + scan.no_returns.size());
  if (sensor.normal_weight > 0.0) {
    collector.set_normals(
        scan_normals(scan.points_m, sensor, sensor.horizontal_pixels, sensor.vertical_pixels));
  }
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    collector.add_point(scan.points_m[i].cast<double>(), static_cast<std::uint32_t>(i));
  }
  for (const Eigen::Vector3f& direction : scan.no_returns) {
    collector.add_no_return(direction.cast<double>());
  }
  return std::move(collector).take();
}

}  // namespace nbvopt
