// The simulated robot as a ROS node. Its parameters are those of the planning node, for the two to
// be told the same, and:
//
//   ~world       a Gazebo world or a mesh
//   ~trajectory  what the base drives, as `nbvopt simulate --trajectory-out` writes it
//   ~camera_hz   clouds a second (5)
#include <ros/ros.h>

#include <string>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "ros1/node/program.hpp"
#include "ros1/robot/simulated_robot.hpp"

namespace nbvopt {
namespace {

std::string needed_text(const ros::NodeHandle& node, const std::string& name) {
  std::string text;
  if (node.getParam(name, text) && !text.empty()) return text;
  throw InputError("parameter " + node.resolveName(name) + " is missing");
}

void run() {
  ros::NodeHandle node;
  const ros::NodeHandle private_node("~");
  NodeParameters parameters = read_parameters(private_node);
  if (parameters.sensor_frame.empty()) parameters.sensor_frame = "camera_optical_frame";
  double camera_hz = 5.0;
  private_node.getParam("camera_hz", camera_hz);
  if (!(camera_hz > 0.0 && camera_hz <= 100.0)) {
    throw InputError("parameter " + private_node.resolveName("camera_hz") + " is " +
                     format_number(camera_hz) + ", it must be greater than 0 and at most 100");
  }
  const Trajectory trajectory = read_trajectory(needed_text(private_node, "trajectory"));
  const World world =
      read_world(needed_text(private_node, "world"),
                 {.model_paths = gazebo_model_paths(), .cache_folder = user_cache_folder()});
  for (const std::string& warning : world.warnings) ROS_WARN("%s", warning.c_str());
  const Scene scene(world.mesh);
  const SimulatedRobot robot(node, parameters, scene, trajectory, camera_hz);
  ros::spin();
}

}  // namespace
}  // namespace nbvopt

int main(int argc, char** argv) {
  return nbvopt::run_node(argc, argv, "simulated_robot", nbvopt::run);
}
