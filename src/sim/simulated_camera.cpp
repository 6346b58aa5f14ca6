#include "nbvopt/sim/simulated_camera.hpp"

#include <cmath>
#include <random>

#include "core/normal.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "sim/people/people_scene.hpp"

namespace nbvopt {

void check_range_noise(double range_noise_m) {
  if (range_noise_m >= 0.0 && std::isfinite(range_noise_m)) return;
  throw InputError("the range noise is " + format_number(range_noise_m) +
                   " m, it must be 0 or more and finite");
}

SimulatedCamera::SimulatedCamera(const Scene& scene, const SensorOptions& sensor,
                                 double range_noise_m, std::uint64_t seed,
                                 const PeopleScene* people)
    : scene_(scene),
      people_(people),
      camera_(sensor),
      pixels_(make_rays(sensor, sensor.horizontal_pixels, sensor.vertical_pixels)),
      range_noise_m_(range_noise_m),
      seed_(seed) {
  check_range_noise(range_noise_m);
}

Scan SimulatedCamera::capture(const Transform& T_map_sensor, std::uint64_t frame) const {
  const std::vector<float> distances_m = cast(pixels_, T_map_sensor);
  std::seed_seq seeds{seed_, seed_ >> 32, frame, frame >> 32};
  std::mt19937_64 random(seeds);

  Scan scan;
  scan.points_m.reserve(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const double noise_m = range_noise_m_ > 0.0 ? range_noise_m_ * standard_normal(random) : 0.0;
    const double distance_m = distances_m[i] + noise_m;
    if (distance_m < pixels_.range_min_m[i]) continue;
    const Eigen::Vector3d direction = pixels_.direction(i);
    if (distance_m < pixels_.range_max_m[i]) {
      scan.points_m.push_back((distance_m * direction).cast<float>());
    } else {
      scan.no_returns.push_back(direction.cast<float>());
    }
  }
  return scan;
}

std::vector<float> SimulatedCamera::planning_distances_m(const Transform& T_map_sensor) const {
  return cast(camera_.rays(), T_map_sensor);
}

std::vector<float> SimulatedCamera::cast(const CameraRays& rays,
                                         const Transform& T_map_sensor) const {
  std::vector<Eigen::Vector3f> directions_map(rays.size());
  const Eigen::Matrix3d& R_map_sensor = T_map_sensor.linear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    directions_map[i] = (R_map_sensor * rays.direction(i)).cast<float>();
  }
  std::vector<float> distances_m(rays.size());
  const auto range_max_m = static_cast<float>(camera_.options().longest_range_m());
  const Eigen::Vector3d origin_map_m = T_map_sensor.translation();
  scene_.first_hits(origin_map_m, directions_map, range_max_m, distances_m);
  if (people_ != nullptr) {
    people_->shorten(origin_map_m, directions_map, range_max_m, distances_m);
  }
  return distances_m;
}

}  // namespace nbvopt
