#include "office_partial.hpp"

#include "nbvopt/map/scan.hpp"
#include "nbvopt/map/voxel_grid.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/planner/robot.hpp"
#include "office_scene.hpp"
#include "simulated_scan.hpp"

namespace nbvopt {

UncertaintyMap make_office_partial() {
  constexpr double kResolution_m = 0.05;
  constexpr JointPosition kCameraStill{.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
  // As a robot that waits gets them; enough that what was seen free saturates, and prunes.
  constexpr int kFramesAtStop = 5;

  const Robot robot;
  const Mast mast(robot.mast);
  const auto world = VoxelGrid::whole(make_office(kResolution_m));

  UncertaintyMap map(kResolution_m);
  for (const Transform& T_map_base : office_stops()) {
    const Transform T_map_sensor = T_map_base * mast.T_base_sensor(kCameraStill);
    const Scan scan = simulate_scan(*world, robot.sensor, T_map_sensor);
    for (int frame = 0; frame < kFramesAtStop; ++frame) {
      insert_scan(map, scan, T_map_sensor, robot.sensor);
    }
  }
  return map;
}

}  // namespace nbvopt
