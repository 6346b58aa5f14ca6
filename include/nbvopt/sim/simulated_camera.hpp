// A depth camera that sees a scene.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/sensor/depth_camera.hpp"
#include "nbvopt/sensor/sensor_options.hpp"
#include "nbvopt/sim/scene.hpp"

namespace nbvopt {

class PeopleScene;  // src/sim/people/people_scene.hpp

/// Throws InputError when a standard deviation of ranges is negative or not finite.
void check_range_noise(double range_noise_m);

/// Takes the depth images of SensorOptions: horizontal_pixels x vertical_pixels, pinhole.
class SimulatedCamera {
 public:
  /// Ranges get Gaussian noise of this standard deviation; 0: none. Throws InputError as
  /// check_range_noise() and SensorOptions::validate() do. The scene must outlive the
  /// camera, and so must the people whom it sees as they stand; null: there is nobody.
  SimulatedCamera(const Scene& scene, const SensorOptions& sensor, double range_noise_m,
                  std::uint64_t seed, const PeopleScene* people = nullptr);

  /// The frame as a driver gives it: a return a pixel that meets a surface in range, a no-return a
  /// pixel that meets none. What stands nearer than range_min_m gives neither. Frames of the same
  /// number from the same pose are equal, noise included, for any number of threads.
  Scan capture(const Transform& T_map_sensor, std::uint64_t frame) const;

  /// The distances along the planning rays, DepthCamera::rays() in their order: +inf where nothing
  /// is nearer than the ray's range_max_m. Without noise, and down to the optical centre.
  std::vector<float> planning_distances_m(const Transform& T_map_sensor) const;

 private:
  std::vector<float> cast(const CameraRays& rays, const Transform& T_map_sensor) const;

  const Scene& scene_;
  const PeopleScene* people_;
  DepthCamera camera_;
  CameraRays pixels_;  ///< of the depth image
  double range_noise_m_;
  std::uint64_t seed_;
};

}  // namespace nbvopt
