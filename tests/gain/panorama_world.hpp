// A camera on a mast, what it stands in, and the panorama of all that it can see.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>

#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {

/// Everything that a panorama is made of; tests change what they are about.
struct PanoramaWorld {
  std::shared_ptr<const VoxelGrid> grid;
  SensorOptions sensor;
  MastOptions mast;
  Transform T_map_base = base_pose(0.03, 0.02, 0.01, 0.3);
  BaseTwist base_twist;
  JointPosition joints{.pan_rad = 0.1, .tilt_rad = -0.05, .height_m = 0.4};
  JointBox box{{-0.8, -0.5, 0.3}, {1.0, 0.4, 0.52}};
  PanoramaOptions options;

  MovingMast moving_mast() const { return {Mast(mast), T_map_base, base_twist, joints}; }
  Transform T_map_sensor(const JointPosition& q) const { return moving_mast().T_map_sensor(q); }
  Panorama panorama() const { return {grid, sensor, moving_mast(), box, options}; }

  double exact_gain(const JointPosition& q) const {
    return make_exact_evaluator(grid, DepthCamera(sensor))->evaluate(T_map_sensor(q)).gain;
  }

  JointPosition random_joints(std::mt19937_64& random) const {
    return {.pan_rad = uniform(random, box.min[0], box.max[0]),
            .tilt_rad = uniform(random, box.min[1], box.max[1]),
            .height_m = uniform(random, box.min[2], box.max[2])};
  }
};

inline std::shared_ptr<const VoxelGrid> unknown_space(double resolution_m) {
  return VoxelGrid::whole(UncertaintyMap(resolution_m));
}

/// Free space within two metres, cluttered with unknown and with occupied voxels.
inline std::shared_ptr<const VoxelGrid> cluttered_space() {
  std::mt19937_64 random(7);
  UncertaintyMap map(0.1);
  scatter(map, cube(key_from_origin(-20, -20, -20), 40), 0.05, random);
  map.finish_writing();
  return VoxelGrid::whole(map);
}

/// A camera in cluttered space whose range ends inside it.
inline PanoramaWorld cluttered_world() {
  PanoramaWorld world;
  world.grid = cluttered_space();
  world.sensor.range_max_m = 1.5;
  return world;
}

/// Where a unit direction of the sensor frame meets what is seen, in that frame.
using SeenPoint = std::function<Eigen::Vector3d(const Eigen::Vector3d& direction_sensor)>;

/// The integral over the image of (1 - u) times the density of rays, by the midpoint rule: what
/// the gain tends to as rays become denser, where all that is seen has u_old = 1.
inline double gain_by_quadrature(const SensorOptions& sensor, const SeenPoint& seen) {
  constexpr int kSide = 400;
  SensorOptions dense = sensor;
  if (sensor.ray_pattern == RayPattern::equal_angles) {
    // Rays from edge to edge stand for cells that reach half a spacing further.
    const auto edge = [](double half_fov_rad, int n) {
      return half_fov_rad * n / (n - 1) * (kSide - 1) / kSide;
    };
    dense.half_fov_horizontal_rad = edge(sensor.half_fov_horizontal_rad, sensor.horizontal_rays);
    dense.half_fov_vertical_rad = edge(sensor.half_fov_vertical_rad, sensor.vertical_rays);
  }
  const CameraRays rays = make_rays(dense, kSide, kSide);
  const UncertaintyModel uncertainty(sensor);
  double sum = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    sum += 1.0 - uncertainty.uncertainty(seen(rays.direction(i)));
  }
  return sum * sensor.horizontal_rays * sensor.vertical_rays / static_cast<double>(rays.size());
}

}  // namespace nbvopt::test
