#include "sim/realised_gain.hpp"

#include <algorithm>
#include <unordered_map>

namespace nbvopt {

double realised_gain(const UncertaintyMap& map, const DepthCamera& camera,
                     std::span<const float> distances_m, const Transform& T_map_sensor) {
  const CameraRays& rays = camera.rays();
  const UncertaintyModel model(camera.options());
  const bool is_per_voxel = camera.options().counting == Counting::per_voxel;
  std::unordered_map<std::uint64_t, double> best_of_voxel;
  double sum = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const double distance_m = distances_m[i];
    if (!(distance_m > rays.range_min_m[i] && distance_m < rays.range_max_m[i])) continue;
    const Eigen::Vector3d p_sensor_m = distance_m * rays.direction(i);
    const VoxelKey key = map.lattice().key(T_map_sensor * p_sensor_m);
    const double gain =
        std::max(0.0, map.at(key).uncertainty - model.uncertainty(p_sensor_m));  // Equation (12)
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
