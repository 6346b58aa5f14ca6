#include "map/scan_uncertainty.hpp"

#include <algorithm>

#include "map/scan_normals.hpp"

namespace nbvopt {

ScanUncertainty::ScanUncertainty(const Scan& scan, const Transform& T_map_sensor,
                                 const SensorOptions& sensor, const Lattice& lattice)
    : scan_(scan), T_map_sensor_(T_map_sensor), lattice_(lattice), model_(sensor), bound_(model_) {
  if (sensor.normal_weight > 0.0) {
    normals_ =
        scan_normals(scan.points_m, sensor, sensor.horizontal_pixels, sensor.vertical_pixels);
  }
}

float ScanUncertainty::of(const ScanHit& hit) const {
  const Eigen::Vector3d p_sensor_m = scan_.points_m[hit.point].cast<double>();
  return static_cast<float>(normals_.empty() ? model_.uncertainty(p_sensor_m)
                                             : model_.uncertainty(p_sensor_m, normal_sensor(hit)));
}

void ScanUncertainty::bound(std::span<const ScanHit> hits, std::span<float> bounds) const {
  constexpr std::size_t kAtOnce = 64;
  using Coordinates = Eigen::Array<float, kAtOnce, 1>;
  Coordinates x = Coordinates::Zero();
  Coordinates y = Coordinates::Zero();
  Coordinates z = Coordinates::Zero();
  for (std::size_t first = 0; first < hits.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, hits.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f& p_sensor_m = scan_.points_m[hits[first + i].point];
      const auto place = static_cast<Eigen::Index>(i);
      x[place] = p_sensor_m.x();
      y[place] = p_sensor_m.y();
      z[place] = p_sensor_m.z();
    }
    const Coordinates some = bound_(x, y, z);
    std::copy_n(some.data(), count, &bounds[first]);
  }
}

/// That of the point, or of the face by which its ray enters the voxel.
Eigen::Vector3d ScanUncertainty::normal_sensor(const ScanHit& hit) const {
  const Eigen::Vector3f& normal = normals_[hit.point];
  if (!normal.isZero()) return normal.cast<double>();
  const Eigen::Vector3d p_map_m = T_map_sensor_ * scan_.points_m[hit.point].cast<double>();
  return T_map_sensor_.linear().transpose() *
         entered_face_normal(lattice_.to_lattice(T_map_sensor_.translation()),
                             lattice_.to_lattice(p_map_m), hit.key);
}

}  // namespace nbvopt
