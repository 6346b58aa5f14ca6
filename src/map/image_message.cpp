#include "map/image_message.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

#include "map/byte_reader.hpp"
#include "map/depth_png.hpp"
#include "map/point_records.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr const char* kMetres = "32FC1";

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

void check_depth_encoding(const std::string& encoding) {
  if (is_depth_encoding(encoding)) return;
  throw InputError("an image is '" + encoding +
                   "', depths are 16UC1 or mono16 (millimetres) or 32FC1 (metres)");
}

void append_metre_row(const char* pixels, std::uint32_t width, std::uint32_t row, std::endian order,
                      const DepthImageOptions& options, Scan& scan) {
  for (std::uint32_t column = 0; column < width; ++column, pixels += sizeof(float)) {
    const double depth_m = decoded_number(pixels, NumberType::f32, order);
    const bool is_clear = depth_m == std::numeric_limits<double>::infinity();
    if (!std::isfinite(depth_m) && !is_clear) continue;
    if (depth_m == 0.0) continue;  // as many drivers have it
    const Eigen::Vector3d direction((column - options.cx_px) / options.fx_px,
                                    (row - options.cy_px) / options.fy_px, 1.0);
    if (is_clear) {
      scan.no_returns.emplace_back(direction.cast<float>());
    } else {
      scan.points_m.emplace_back((direction * depth_m).cast<float>());
    }
  }
}

/// How compressedDepth turns metres into numbers of 16 bits.
struct InverseDepth {
  double a = 0.0, b = 0.0;  ///< number = a / depth + b

  float depth_m(std::uint16_t number) const {
    const auto depth_m = static_cast<float>(a / (number - b));
    const bool is_known = number != 0 && depth_m > 0.0F && std::isfinite(depth_m);
    return is_known ? depth_m : std::numeric_limits<float>::quiet_NaN();
  }
};

/// compressedDepth's header: a format, which nobody reads, and the two of InverseDepth.
constexpr std::size_t kHeaderBytes = 12;

InverseDepth inverse_depth(std::string_view header) {
  const InverseDepth depth{.a = number_at<float>(header.data() + 4),
                           .b = number_at<float>(header.data() + 8)};
  if (std::isfinite(depth.a) && std::isfinite(depth.b) && depth.a > 0.0) return depth;
  throw InputError("a compressed image's header does not say how 16-bit numbers become metres");
}

}  // namespace

bool is_depth_encoding(const std::string& encoding) {
  return encoding == "16UC1" || encoding == "mono16" || encoding == kMetres;
}

std::string encoding_of(const CompressedImageMessage& image) {
  return image.format.substr(0, image.format.find_first_of("; "));
}

std::string camera_info_beside(const std::string& image_topic) {
  return image_topic.substr(0, image_topic.rfind('/') + 1) + "camera_info";
}

DepthImageOptions depth_image_options(const CameraInfoMessage& info) {
  DepthImageOptions options;
  if (info.P[0] != 0.0) {
    options.fx_px = info.P[0];
    options.cx_px = info.P[2];
    options.fy_px = info.P[5];
    options.cy_px = info.P[6];
  } else {
    options.fx_px = info.K[0];
    options.cx_px = info.K[2];
    options.fy_px = info.K[4];
    options.cy_px = info.K[5];
  }
  options.validate();
  return options;
}

void check_image_size(const ImageMessage& image, const CameraInfoMessage& info) {
  const bool says_nothing = info.width == 0 && info.height == 0;
  if (says_nothing || (image.width == info.width && image.height == info.height)) return;
  throw InputError("an image has " + size_text(image.width, image.height) +
                   ", its camera_info is of " + size_text(info.width, info.height));
}

Scan scan_of(const ImageMessage& image, const DepthImageOptions& options) {
  check_depth_encoding(image.encoding);
  const bool is_metres = image.encoding == kMetres;
  const std::uint64_t row_bytes =
      std::uint64_t{image.width} * (is_metres ? sizeof(float) : sizeof(std::uint16_t));
  const bool is_whole =
      image.height == 0 || image.width == 0 ||
      (image.step >= row_bytes &&
       image.data.size() >= std::uint64_t{image.height - 1} * image.step + row_bytes);
  if (!is_whole) {
    throw InputError("an image of " + size_text(image.width, image.height) + " has " +
                     std::to_string(image.data.size()) + " bytes of data");
  }
  Scan scan;
  if (image.width == 0) return scan;
  const std::endian order = image.is_bigendian ? std::endian::big : std::endian::little;
  std::vector<std::uint16_t> depths(is_metres ? 0 : image.width);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const char* pixels =
        reinterpret_cast<const char*>(image.data.data()) + std::uint64_t{row} * image.step;
    if (is_metres) {
      append_metre_row(pixels, image.width, row, order, options, scan);
      continue;
    }
    for (std::uint16_t& depth : depths) {
      depth = static_cast<std::uint16_t>(decoded_number(pixels, NumberType::u16, order));
      pixels += sizeof(std::uint16_t);
    }
    append_depth_row(depths, row, options, scan);
  }
  return scan;
}

ImageMessage unpack(const CompressedImageMessage& message, std::vector<std::uint8_t>& bytes) {
  ImageMessage image{.encoding = encoding_of(message)};
  check_depth_encoding(image.encoding);
  const bool is_metres = image.encoding == kMetres;
  constexpr std::string_view kPng = "\x89PNG";
  const std::string_view data(reinterpret_cast<const char*>(message.data.data()),
                              message.data.size());
  // The transport `compressed` has no header; it packs no metres.
  const std::size_t png_at = data.starts_with(kPng) && !is_metres ? 0 : kHeaderBytes;
  if (!data.substr(std::min(png_at, data.size())).starts_with(kPng)) {
    throw InputError("a compressed image holds no PNG, its format is '" + message.format +
                     "': set the transport's format to png");
  }
  const InverseDepth depth = is_metres ? inverse_depth(data) : InverseDepth{};
  bytes.clear();
  const auto append_bytes = [&bytes](const auto& number) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&number);
    bytes.insert(bytes.end(), first, first + sizeof(number));
  };
  std::istringstream png{std::string(data.substr(png_at))};
  for_each_png_row(png, "a compressed image",
                   [&](std::uint32_t row, std::span<const std::uint16_t> pixels) {
                     image.width = static_cast<std::uint32_t>(pixels.size());
                     image.height = row + 1;
                     if (std::uint64_t{image.width} * image.height > kMostUnpackedPixels) {
                       throw InputError("a compressed image has more than " +
                                        std::to_string(kMostUnpackedPixels) + " pixels");
                     }
                     for (const std::uint16_t pixel : pixels) {
                       is_metres ? append_bytes(depth.depth_m(pixel)) : append_bytes(pixel);
                     }
                   });
  image.step =
      image.width * static_cast<std::uint32_t>(is_metres ? sizeof(float) : sizeof(std::uint16_t));
  image.data = bytes;
  return image;
}

}  // namespace nbvopt
