// A loop to drive: a gallery around a block of rooms.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "nbvopt/sim/scene.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "sim/box_mesh.hpp"

namespace nbvopt::test {

/// 9 x 7 m with a block in the middle, and things along the walls that tell places apart.
inline TriangleMesh ring_mesh() {
  TriangleMesh mesh;
  add_box(mesh, {-4.53, -3.53, -0.03}, {4.53, 3.53, 2.53});
  add_box(mesh, {-2.02, -1.03, -0.03}, {2.04, 1.01, 2.53});    // block
  add_box(mesh, {-4.53, -0.52, -0.03}, {-3.98, 0.61, 1.8});    // cupboard
  add_box(mesh, {0.32, 2.94, -0.03}, {1.77, 3.53, 1.1});       // sideboard
  add_box(mesh, {3.93, 0.83, -0.03}, {4.53, 1.51, 2.53});      // chimney
  add_box(mesh, {-1.52, -3.53, -0.03}, {-0.93, -3.04, 2.53});  // pillar
  add_box(mesh, {2.01, -3.53, -0.03}, {2.53, -3.21, 0.9});     // box
  return mesh;
}

/// Once around the block at 0.25 m/s, turning on the spot at 0.5 rad/s.
inline Trajectory ring_drive() {
  constexpr double kPeriod_s = 0.05;
  constexpr double kStep_m = 0.25 * kPeriod_s;
  constexpr double kTurn_rad = 0.5 * kPeriod_s;
  const std::array<Eigen::Vector2d, 5> corners{
      {{-3.0, -2.0}, {3.0, -2.0}, {3.0, 2.0}, {-3.0, 2.0}, {-3.0, -2.0}}};
  std::vector<TrajectoryPoint> points;
  double yaw_rad = 0.0;
  const auto add = [&](const Eigen::Vector2d& position_m) {
    points.push_back({kPeriod_s * static_cast<double>(points.size()), position_m.x(),
                      position_m.y(), 0.0, yaw_rad});
  };
  for (std::size_t side = 0; side + 1 < corners.size(); ++side) {
    const Eigen::Vector2d way_m = corners[side + 1] - corners[side];
    const int steps = static_cast<int>(way_m.norm() / kStep_m);
    for (int i = 0; i < steps; ++i) add(corners[side] + i * kStep_m * way_m.normalized());
    const int turns = static_cast<int>(0.5 * std::numbers::pi / kTurn_rad);
    for (int i = 0; i < turns; ++i, yaw_rad += kTurn_rad) add(corners[side + 1]);
  }
  return Trajectory(points);
}

}  // namespace nbvopt::test
