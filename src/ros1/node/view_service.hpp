// The service optimize_current_pose: where should the camera look next? It is sent there.
#pragma once

#include <nav_msgs/Path.h>
#include <reconstruction_3d_planner/OptimizeCurrentPose.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <mutex>
#include <vector>

#include "ros1/node/joints.hpp"
#include "ros1/node/parameters.hpp"
#include "ros1/node/scan_input.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

/// Plans from where base and joints are, commands the joints, and answers once they have arrived
/// and a cloud from there is in the map. Heeds the newest path on base_path.
class ViewService {
 public:
  /// The service is answered on the queue of `service_node`: one call at a time.
  ViewService(ros::NodeHandle& node, ros::NodeHandle& service_node,
              const NodeParameters& parameters, const tf2_ros::Buffer& tf, MapStore& store,
              Joints& joints, ScanInput& scans);

 private:
  using Request = reconstruction_3d_planner::OptimizeCurrentPose::Request;
  using Response = reconstruction_3d_planner::OptimizeCurrentPose::Response;

  bool optimize(Request& request, Response& response);
  PlanRequest request_now(double motion_time_s) const;
  /// Where the path has the base from now on; empty without one that still lies ahead.
  std::vector<TimedPose> base_path() const;
  void wait_for_view(const PlanResult& look, Response& response);
  void warn_of_other_mast(const PlanRequest& request) const;

  const NodeParameters& parameters_;
  const tf2_ros::Buffer& tf_;
  MapStore& store_;
  Joints& joints_;
  ScanInput& scans_;
  mutable std::mutex mutex_;  ///< of what follows
  nav_msgs::Path::ConstPtr path_;
  ros::Subscriber path_subscriber_;
  ros::ServiceServer service_;  ///< the last member: its calls end before the others go
};

}  // namespace nbvopt
