// Plans a view on a map made in memory, with the installed package alone.
#include <cstdio>

#include "nbvopt/planner/view_planner.hpp"

int main() {
  const nbvopt::Robot robot;
  const nbvopt::ViewPlanner planner(nbvopt::UncertaintyMap(0.1), robot);

  nbvopt::PlanRequest request;
  request.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};
  request.motion_time_s = 0.5;
  const nbvopt::PlanResult result =
      planner.plan(request, {.solver = "grid", .grid_steps = {0.4, 0.2, 0.0}});

  // Nothing is known of the map, so every ray of every view ends in an unknown voxel.
  std::printf("%s: gain %.1f\n", nbvopt::to_string(result.status).c_str(), result.view.gain);
  const int rays = robot.sensor.horizontal_rays * robot.sensor.vertical_rays;
  return result.view.unknown_rays == rays && result.box.contains(result.joints.vector()) ? 0 : 1;
}
