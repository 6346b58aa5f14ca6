// Depth images as ROS messages hold them (sensor_msgs/Image, CompressedImage, CameraInfo), whoever
// has unpacked the message.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/map/depth_image.hpp"
#include "nbvopt/map/scan.hpp"

namespace nbvopt {

/// sensor_msgs/Image without its header, `data` not copied.
struct ImageMessage {
  std::uint32_t height = 0, width = 0;
  std::string encoding{};
  bool is_bigendian = false;
  std::uint32_t step = 0;  ///< bytes of a row
  std::span<const std::uint8_t> data{};
};

/// sensor_msgs/CompressedImage without its header, `data` not copied.
struct CompressedImageMessage {
  std::string format{};
  std::span<const std::uint8_t> data{};
};

/// What depth images need of a sensor_msgs/CameraInfo.
struct CameraInfoMessage {
  std::uint32_t height = 0, width = 0;
  std::array<double, 9> K{};   ///< of images as they are taken
  std::array<double, 12> P{};  ///< of rectified ones
};

/// Whether images of that encoding hold depths: 16UC1, mono16 or 32FC1.
bool is_depth_encoding(const std::string& encoding);

/// Of the image that was compressed: what the format begins with.
std::string encoding_of(const CompressedImageMessage& image);

/// The topic beside an image's, as drivers name it: /camera/depth/camera_info of
/// /camera/depth/image_raw.
std::string camera_info_beside(const std::string& image_topic);

/// The pinhole camera by P, by K where P is empty. The other options are the defaults. Throws
/// InputError where neither has focal lengths.
DepthImageOptions depth_image_options(const CameraInfoMessage& info);

/// Throws InputError, naming both sizes, where a camera_info says that it is of images of another.
void check_image_size(const ImageMessage& image, const CameraInfoMessage& info);

/// The points of a depth image, in its optical frame. 16-bit numbers count as `options` say; 32-bit
/// ones are metres along the optical axis (REP 118): not finite ones are not known, but +inf, which
/// is nothing in range. Throws InputError for another encoding, and where data end too soon.
Scan scan_of(const ImageMessage& image, const DepthImageOptions& options);

/// Larger images are refused.
inline constexpr std::size_t kMostUnpackedPixels = std::size_t{1} << 26;

/// Unpacks what the transports compressedDepth and compressed make of depth images with their
/// format png: 16-bit numbers as they are, and metres as numbers that grow with the inverse depth,
/// 0 being not known. The image's data are put into `bytes`. Throws InputError for other encodings
/// and formats, where data are damaged, and for more than kMostUnpackedPixels.
ImageMessage unpack(const CompressedImageMessage& message, std::vector<std::uint8_t>& bytes);

}  // namespace nbvopt
