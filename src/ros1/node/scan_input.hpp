// What the camera sees goes into the map.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

#include "map/image_message.hpp"
#include "nbvopt/map/recording.hpp"
#include "ros1/node/image_input.hpp"
#include "ros1/node/parameters.hpp"
#include "server/map_store.hpp"

namespace nbvopt {

/// Subscribes to cloud_in and to depth_in with the camera_info beside it, whose clouds and depth
/// images it inserts from where tf has the sensor at their time.
class ScanInput {
 public:
  ScanInput(ros::NodeHandle& node, const NodeParameters& parameters, const tf2_ros::Buffer& tf,
            MapStore& store);

  /// Waits until a scan is in the map that was taken at that time or later; false: none came in
  /// so many seconds.
  bool wait_for_scan_since(const ros::Time& time, double timeout_s);

 private:
  void subscribe_to_images(ros::NodeHandle& node);
  PosedScan posed(const sensor_msgs::PointCloud2& cloud) const;
  /// An image's own frame is optical. Its header is told apart.
  PosedScan posed(const ImageMessage& image, const std_msgs::Header& header,
                  const sensor_msgs::CameraInfo& info) const;
  /// Inserts what `make` gives; what is wrong with it is logged by the name `what`.
  void insert(const char* what, const ros::Time& time, const std::function<PosedScan()>& make);

  const NodeParameters& parameters_;
  const tf2_ros::Buffer& tf_;
  MapStore& store_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable has_scan_;
  ros::Time newest_;
  // The last members: their calls end before the others go.
  ros::Subscriber clouds_;
  std::optional<ImageInput<sensor_msgs::Image>> images_;
  std::optional<ImageInput<sensor_msgs::CompressedImage>> compressed_images_;
};

}  // namespace nbvopt
