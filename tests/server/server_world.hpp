// What the server's tests plan and map in: a small closed room, half known.
#pragma once

#include "nbvopt/map/scan.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {

/// A cheap camera, so that a plan takes a millisecond.
inline Robot small_robot() {
  Robot robot;
  robot.sensor.horizontal_rays = 16;
  robot.sensor.vertical_rays = 12;
  robot.sensor.range_max_m = 2.0;
  return robot;
}

/// 4 x 4 x 1 m of free space with a wall on one side; the rest is unknown.
inline UncertaintyMap small_map() {
  UncertaintyMap map(0.1);
  set_box(map, keys_between(map.lattice(), {-1.0, -1.0, 0.0}, {1.0, 1.0, 1.0}), kFree);
  set_box(map, keys_between(map.lattice(), {1.0, -1.0, 0.0}, {1.1, 1.0, 1.0}), occupied(0.5F));
  map.finish_writing();
  return map;
}

inline PlanRequest small_request() {
  PlanRequest request;
  request.T_map_base = base_pose(0.0, 0.0, 0.0, 0.3);
  request.joints = {.pan_rad = 0.1, .tilt_rad = 0.0, .height_m = 0.4};
  request.motion_time_s = 0.5;
  return request;
}

/// Points on a wall `distance_m` away, and nothing to the right.
inline Scan small_scan(double distance_m = 1.5) {
  Scan scan;
  for (int i = -20; i <= 20; ++i) {
    for (int j = -15; j <= 15; ++j) {
      const Eigen::Vector3f direction(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(j),
                                      1.0F);
      if (i > 15) {
        scan.no_returns.push_back(direction);
      } else {
        scan.points_m.push_back(direction * static_cast<float>(distance_m));
      }
    }
  }
  return scan;
}

/// The camera of the `i`-th scan of a drive.
inline Transform scan_pose(int i) {
  const Mast mast{MastOptions{}};
  return base_pose(0.02 * i, -0.01 * i, 0.0, 0.05 * i) * mast.T_base_sensor({0.0, 0.0, 0.4});
}

}  // namespace nbvopt::test
