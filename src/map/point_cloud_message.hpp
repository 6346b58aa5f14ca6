// Clouds as ROS messages hold them (sensor_msgs/PointCloud2), whoever has unpacked the message.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// A number of each point (sensor_msgs/PointField).
struct PointCloudField {
  std::string name;
  std::uint32_t offset = 0;  ///< bytes from the point's start
  std::uint8_t datatype =
      0;  ///< int8, uint8, int16, uint16, int32, uint32, float32, float64: 1 to 8
  std::uint32_t count = 1;
};

/// The message without its header, `data` not copied.
struct PointCloudMessage {
  std::uint32_t height = 0, width = 0;
  std::vector<PointCloudField> fields{};
  bool is_bigendian = false;
  std::uint32_t point_step = 0, row_step = 0;  ///< bytes
  std::span<const std::uint8_t> data{};
};

/// The points, in the cloud's frame, with their colours where there are any (`rgb` or `rgba`).
/// Throws InputError where x, y or z is missing or no number, or data end before the last point.
Scan scan_of(const PointCloudMessage& cloud);

}  // namespace nbvopt
