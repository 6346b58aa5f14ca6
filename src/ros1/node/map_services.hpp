// The services of the paper's map server.
#pragma once

#include <octomap_msgs/BoundingBoxQuery.h>
#include <octomap_msgs/EstimateGain.h>
#include <octomap_msgs/GetAABBoxValue.h>
#include <octomap_msgs/GetOctomap.h>
#include <octomap_msgs/GetValue.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>

#include <vector>

#include "ros1/node/parameters.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

/// estimate_gain, get_map_info, get_map_voxels, get_AABBox_info, get_AABBox_gain, clear_bbx and
/// reset under the node's own name, octomap_binary and octomap_full. A call that cannot be answered
/// fails, and roscpp tells client and log why.
class MapServices {
 public:
  MapServices(ros::NodeHandle& node, ros::NodeHandle& private_node,
              const NodeParameters& parameters, const tf2_ros::Buffer& tf, MapStore& store);

 private:
  void estimate_gain(const octomap_msgs::EstimateGain::Request& request,
                     octomap_msgs::EstimateGain::Response& response) const;
  void box_value(const octomap_msgs::GetAABBoxValue::Request& request,
                 octomap_msgs::GetAABBoxValue::Response& response, bool is_gain) const;
  void get_octomap(octomap_msgs::GetOctomap::Response& response, bool is_binary) const;

  /// Advertises a service; what the answer throws roscpp logs, and sends to the client as an error.
  template <class Request, class Response, class Answer>
  void advertise(ros::NodeHandle& node, const std::string& name, const Answer& answer);

  const NodeParameters& parameters_;
  const tf2_ros::Buffer& tf_;
  MapStore& store_;
  std::vector<ros::ServiceServer> servers_;  ///< last: their calls end before the others go
};

}  // namespace nbvopt
