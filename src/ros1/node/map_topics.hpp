// Publishes the map as it grows.
#pragma once

#include <ros/ros.h>

#include <functional>
#include <vector>

#include "ros1/node/parameters.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

/// Publishes the newest map on octomap_full, octomap_binary, occupied_cells_vis_array,
/// free_cells_vis_array, octomap_point_cloud_centers and projected_map: each only where somebody
/// listens, and at most once a period. The last message is kept for who comes later (latched).
class MapTopics {
 public:
  MapTopics(ros::NodeHandle& node, const NodeParameters& parameters, const MapStore& store);

 private:
  struct Topic {
    ros::Publisher publisher;
    std::function<void(const ros::Publisher&, const UncertaintyMap&, const std_msgs::Header&)>
        publish;
    std::uint64_t version = 0;  ///< of the map that was published last
  };
  template <class Message>
  void add(ros::NodeHandle& node, const std::string& name,
           std::function<Message(const UncertaintyMap&)> make);
  void publish();

  const MapStore& store_;
  std::string map_frame_;
  std::vector<Topic> topics_;
  ros::WallTimer timer_;  ///< the last member: its calls end before the others go
};

}  // namespace nbvopt
