// The messages of ROS 1 that a bag is read for, from their bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "map/point_cloud_message.hpp"
#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/depth_image.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// std_msgs/Header, which these messages begin with.
struct MessageHeader {
  double time_s = 0.0;
  std::string frame;
};

/// sensor_msgs/CameraInfo.
struct CameraInfoMessage {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  double fx_px = 0.0, fy_px = 0.0, cx_px = 0.0, cy_px = 0.0;  ///< of P; of K where P is empty
};

/// sensor_msgs/Image. `data` are bytes of the message.
struct ImageMessage {
  MessageHeader header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;
  bool is_bigendian = false;
  std::uint32_t step = 0;  ///< bytes of a row
  std::string_view data;
};

/// A transform of tf2_msgs/TFMessage or tf/tfMessage.
struct TransformMessage {
  MessageHeader header;
  std::string child_frame;
  Transform T_frame_child = Transform::Identity();
};

// All of them throw InputError where the bytes end before the message does.

MessageHeader parse_header(std::string_view message);
CameraInfoMessage parse_camera_info(std::string_view message);
ImageMessage parse_image(std::string_view message);
/// Those with numbers that are no pose are left out.
std::vector<TransformMessage> parse_transforms(std::string_view message);

/// sensor_msgs/PointCloud2, `header` apart; its data are bytes of the message.
PointCloudMessage parse_point_cloud(std::string_view message, MessageHeader& header);

/// Whether images of that encoding hold depths: 16UC1, mono16 or 32FC1.
bool is_depth_encoding(const std::string& encoding);

/// The points of a depth image, in its optical frame. 16-bit numbers count as `options` say; 32-bit
/// ones are metres along the optical axis (REP 118): not finite ones are not known, but +inf, which
/// is nothing in range. Throws InputError for another encoding, and where data end too soon.
Scan scan_of(const ImageMessage& image, const DepthImageOptions& options);

}  // namespace nbvopt
