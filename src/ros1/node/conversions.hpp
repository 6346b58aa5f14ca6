// ROS messages and our types.
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>

#include <initializer_list>
#include <string>

#include "map/image_message.hpp"
#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// Throws InputError when a number is not finite or the quaternion's length is zero.
Transform transform_of(const geometry_msgs::Transform& message);
Transform transform_of(const geometry_msgs::Pose& message);

geometry_msgs::Pose pose_message(const Transform& transform);
geometry_msgs::Transform transform_message(const Transform& transform);
geometry_msgs::Point point_message(const Eigen::Vector3d& point);
Eigen::Vector3d point_of(const geometry_msgs::Point& message);

/// T_to_from at a time, 0 being the newest; waits a little for what is still on its way. Throws
/// tf2::TransformException when tf does not know it.
Transform look_up(const tf2_ros::Buffer& tf, const std::string& to, const std::string& from,
                  const ros::Time& time = ros::Time(0));

/// A cloud without points, each of which has these fields, floats one after the other.
sensor_msgs::PointCloud2 cloud_of_floats(std::initializer_list<const char*> fields);

/// Those of ours refer to the data of these.
ImageMessage image_of(const sensor_msgs::Image& message);
CompressedImageMessage image_of(const sensor_msgs::CompressedImage& message);
CameraInfoMessage camera_info_of(const sensor_msgs::CameraInfo& message);

/// In the cloud's frame. Throws InputError as scan_of(PointCloudMessage) does.
Scan scan_of(const sensor_msgs::PointCloud2& message);

}  // namespace nbvopt
