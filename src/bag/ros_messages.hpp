// The messages of ROS 1 that a bag is read for, from their bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "map/image_message.hpp"
#include "map/point_cloud_message.hpp"
#include "nbvopt/core/transform.hpp"

namespace nbvopt {

/// std_msgs/Header, which these messages begin with.
struct MessageHeader {
  double time_s = 0.0;
  std::string frame;
};

/// A transform of tf2_msgs/TFMessage or tf/tfMessage.
struct TransformMessage {
  MessageHeader header;
  std::string child_frame;
  Transform T_frame_child = Transform::Identity();
};

// All of them throw InputError where the bytes end before the message does.

MessageHeader parse_header(std::string_view message);
/// Those with numbers that are no pose are left out.
std::vector<TransformMessage> parse_transforms(std::string_view message);

// Those of sensor_msgs, their header apart; their data are bytes of the message.

CameraInfoMessage parse_camera_info(std::string_view message);
ImageMessage parse_image(std::string_view message);
CompressedImageMessage parse_compressed_image(std::string_view message);
PointCloudMessage parse_point_cloud(std::string_view message);

}  // namespace nbvopt
