#include "sim/realised_gain.hpp"

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "map/scan_normals.hpp"

namespace nbvopt {
namespace {

/// Where normals count: of what each planning ray met, zero where that is not known.
std::vector<Eigen::Vector3f> normals_seen(const DepthCamera& camera,
                                          std::span<const float> distances_m) {
  const SensorOptions& sensor = camera.options();
  if (sensor.normal_weight == 0.0) return {};
  std::vector<Eigen::Vector3f> points_m;
  for (std::size_t i = 0; i < camera.rays().size(); ++i) {
    points_m.push_back((distances_m[i] * camera.rays().direction(i)).cast<float>());
  }
  return scan_normals(points_m, sensor, sensor.horizontal_rays, sensor.vertical_rays);
}

}  // namespace

double realised_gain(const UncertaintyMap& map, const DepthCamera& camera,
                     std::span<const float> distances_m, const Transform& T_map_sensor) {
  const CameraRays& rays = camera.rays();
  const UncertaintyModel model(camera.options());
  const bool is_per_voxel = camera.options().counting == Counting::per_voxel;
  std::unordered_map<std::uint64_t, double> best_of_voxel;
  double sum = 0.0;
  const std::vector<Eigen::Vector3f> normals = normals_seen(camera, distances_m);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double distance_m = distances_m[i];
    if (!(distance_m > rays.range_min_m[i] && distance_m < rays.range_max_m[i])) continue;
    const Eigen::Vector3d p_sensor_m = distance_m * rays.direction(i);
    const VoxelKey key = map.lattice().key(T_map_sensor * p_sensor_m);
    const double u_new = normals.empty() ? model.uncertainty(p_sensor_m)
                                         : model.uncertainty(p_sensor_m, normals[i].cast<double>());
    const double gain = std::max(0.0, map.at(key).uncertainty - u_new);  // Equation (12)
    if (is_per_voxel) {
      double& best = best_of_voxel[packed(key)];
      sum += std::max(0.0, gain - best);  // Equation (13), each voxel once
      best = std::max(best, gain);
    } else {
      sum += gain;  // Section III-B.2, each ray
    }
  }
  return sum;
}

}  // namespace nbvopt
