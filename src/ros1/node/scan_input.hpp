// Clouds that come in go into the map.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>

#include <condition_variable>
#include <mutex>

#include "ros1/node/parameters.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

/// Subscribes to cloud_in, whose clouds it inserts from where tf has the sensor at their time.
class ScanInput {
 public:
  ScanInput(ros::NodeHandle& node, const NodeParameters& parameters, const tf2_ros::Buffer& tf,
            MapStore& store);

  /// Waits until a cloud is in the map that was taken at that time or later; false: none came in
  /// so many seconds.
  bool wait_for_scan_since(const ros::Time& time, double timeout_s);

 private:
  void on_cloud(const sensor_msgs::PointCloud2& cloud);

  const NodeParameters& parameters_;
  const tf2_ros::Buffer& tf_;
  MapStore& store_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable has_scan_;
  ros::Time newest_;
  ros::Subscriber subscriber_;  ///< the last member: its calls end before the others go
};

}  // namespace nbvopt
