// The ROS node: the map, and where the camera looks next, by the names and types of the paper's
// released system.
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <string>
#include <vector>

#include "nbvopt/map/map_file.hpp"
#include "ros1/node/joints.hpp"
#include "ros1/node/map_services.hpp"
#include "ros1/node/map_topics.hpp"
#include "ros1/node/parameters.hpp"
#include "ros1/node/program.hpp"
#include "ros1/node/scan_input.hpp"
#include "ros1/node/view_service.hpp"
#include "server/map_store.hpp"

namespace nbvopt {
namespace {

/// Callbacks that others must not wait for, and the threads that run them.
class Queue {
 public:
  explicit Queue(std::uint32_t threads) : spinner_(threads, &queue_) {}
  void serve(ros::NodeHandle& node) { node.setCallbackQueue(&queue_); }
  void start() { spinner_.start(); }
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
};

UncertaintyMap first_map(const NodeParameters& parameters) {
  if (parameters.map_file.empty()) return UncertaintyMap(parameters.resolution_m);
  std::vector<std::string> warnings;
  UncertaintyMap map = read_map(parameters.map_file, warnings);
  for (const std::string& warning : warnings) ROS_WARN("%s", warning.c_str());
  return map;
}

void run() {
  ros::NodeHandle private_node("~");
  const NodeParameters parameters = read_parameters(private_node);
  MapStore store(parameters.robot, {}, first_map(parameters), 1);
  constexpr double kTfMemory_s = 30.0;
  tf2_ros::Buffer tf{ros::Duration(kTfMemory_s)};
  const tf2_ros::TransformListener listener(tf);

  // optimize_current_pose waits for joints and clouds; a viewer's map takes long to make.
  Queue robot_queue(2), view_queue(1), service_queue(2), topic_queue(1);
  ros::NodeHandle robot_node, view_node, service_node, topic_node;
  robot_queue.serve(robot_node);
  view_queue.serve(view_node);
  service_queue.serve(service_node);
  service_queue.serve(private_node);
  topic_queue.serve(topic_node);

  Joints joints(robot_node, parameters);
  ScanInput scans(robot_node, parameters, tf, store);
  const ViewService views(robot_node, view_node, parameters, tf, store, joints, scans);
  const MapServices services(service_node, private_node, parameters, tf, store);
  const MapTopics topics(topic_node, parameters, store);
  for (Queue* queue : {&robot_queue, &view_queue, &service_queue, &topic_queue}) queue->start();
  ROS_INFO("ready: a map of %g m voxels in the frame %s",
           store.published()->grid()->lattice().resolution_m(), parameters.map_frame.c_str());
  ros::waitForShutdown();
  for (Queue* queue : {&view_queue, &service_queue, &topic_queue, &robot_queue}) queue->stop();
}

}  // namespace
}  // namespace nbvopt

int main(int argc, char** argv) {
  // The paper's map server, whose private services others call by this name.
  return nbvopt::run_node(argc, argv, "octomap_server", nbvopt::run);
}
