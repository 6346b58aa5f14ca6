// A room to run episodes in.
#pragma once

#include <vector>

#include "nbvopt/planner/robot.hpp"
#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "sim/box_mesh.hpp"

namespace nbvopt::test {

/// 8 x 6 x 2.5 m with a pillar, a table and a cupboard; the floor is off the voxels' faces.
inline TriangleMesh room_mesh() {
  TriangleMesh mesh;
  add_box(mesh, {-4.03, -3.03, -0.03}, {4.03, 3.03, 2.53});
  add_box(mesh, {1.52, -0.47, -0.03}, {2.03, 0.04, 2.53});    // pillar
  add_box(mesh, {-2.52, 1.03, 0.68}, {-1.04, 2.03, 0.73});    // table top
  add_box(mesh, {-4.03, -2.97, -0.03}, {-3.52, -1.04, 1.8});  // cupboard
  return mesh;
}

/// From (-2, 0) two metres along x within ten seconds.
inline Trajectory straight_drive() {
  std::vector<TrajectoryPoint> points;
  for (int i = 0; i <= 200; ++i) {
    points.push_back({.time_s = i / 20.0, .x_m = -2.0 + 0.01 * i, .yaw_rad = 0.0});
  }
  return Trajectory(points);
}

/// The paper's platform, its depth image thinned out.
inline Robot coarse_robot() {
  Robot robot;
  robot.sensor.horizontal_pixels = 120;
  robot.sensor.vertical_pixels = 90;
  return robot;
}

}  // namespace nbvopt::test
