#include "bag/ros_messages.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "map/byte_reader.hpp"
#include "map/point_records.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// A message's bytes, taken from the front.
class Bytes {
 public:
  explicit Bytes(std::string_view rest) : rest_(rest) {}

  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw InputError("a message ends before its last field");
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }
  template <class Number>
  Number number() {
    return number_at<Number>(take(sizeof(Number)).data());
  }
  std::uint32_t count() { return number<std::uint32_t>(); }
  std::string_view sized() { return take(count()); }  // of a string, or an array of bytes
  std::string text() { return std::string(sized()); }

  /// How many there are of what takes so many bytes at least.
  std::uint32_t count_of(std::uint64_t bytes_each) {
    const std::uint32_t many = count();
    if (many * bytes_each > rest_.size()) throw InputError("a message ends before its last field");
    return many;
  }

 private:
  std::string_view rest_;
};

MessageHeader take_header(Bytes& bytes) {
  bytes.count();  // the sequence number
  const auto seconds = bytes.number<std::uint32_t>();
  const auto nanoseconds = bytes.number<std::uint32_t>();
  return {.time_s = seconds + 1e-9 * nanoseconds, .frame = bytes.text()};
}

template <std::size_t N>
std::array<double, N> take_doubles(Bytes& bytes) {
  std::array<double, N> numbers{};
  for (double& number : numbers) number = bytes.number<double>();
  return numbers;
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

}  // namespace

MessageHeader parse_header(std::string_view message) {
  Bytes bytes(message);
  return take_header(bytes);
}

CameraInfoMessage parse_camera_info(std::string_view message) {
  Bytes bytes(message);
  CameraInfoMessage info;
  info.header = take_header(bytes);
  info.height = bytes.count();
  info.width = bytes.count();
  bytes.sized();                                                // the distortion's model
  bytes.take(bytes.count_of(sizeof(double)) * sizeof(double));  // its parameters
  const auto K = take_doubles<9>(bytes);
  take_doubles<9>(bytes);  // the rectifying rotation
  const auto P = take_doubles<12>(bytes);
  if (P[0] != 0.0) {
    info.fx_px = P[0];
    info.cx_px = P[2];
    info.fy_px = P[5];
    info.cy_px = P[6];
  } else {
    info.fx_px = K[0];
    info.cx_px = K[2];
    info.fy_px = K[4];
    info.cy_px = K[5];
  }
  return info;
}

ImageMessage parse_image(std::string_view message) {
  Bytes bytes(message);
  ImageMessage image;
  image.header = take_header(bytes);
  image.height = bytes.count();
  image.width = bytes.count();
  image.encoding = bytes.text();
  image.is_bigendian = bytes.number<std::uint8_t>() != 0;
  image.step = bytes.count();
  image.data = bytes.sized();
  return image;
}

std::vector<TransformMessage> parse_transforms(std::string_view message) {
  constexpr std::uint64_t kLeastBytes = 12 + 4 + 4 + 7 * sizeof(double);
  Bytes bytes(message);
  std::vector<TransformMessage> transforms;
  for (std::uint32_t many = bytes.count_of(kLeastBytes); many > 0; --many) {
    TransformMessage transform;
    transform.header = take_header(bytes);
    transform.child_frame = bytes.text();
    const auto position_m = take_doubles<3>(bytes);
    const auto orientation_xyzw = take_doubles<4>(bytes);
    try {
      transform.T_frame_child = pose_from_quaternion(position_m, orientation_xyzw);
    } catch (const InputError&) {
      continue;
    }
    transforms.push_back(std::move(transform));
  }
  return transforms;
}

PointCloudMessage parse_point_cloud(std::string_view message, MessageHeader& header) {
  Bytes bytes(message);
  header = take_header(bytes);
  PointCloudMessage cloud;
  cloud.height = bytes.count();
  cloud.width = bytes.count();
  constexpr std::uint64_t kLeastFieldBytes = 4 + 4 + 1 + 4;
  for (std::uint32_t many = bytes.count_of(kLeastFieldBytes); many > 0; --many) {
    PointCloudField field;
    field.name = bytes.text();
    field.offset = bytes.count();
    field.datatype = bytes.number<std::uint8_t>();
    field.count = bytes.count();
    cloud.fields.push_back(std::move(field));
  }
  cloud.is_bigendian = bytes.number<std::uint8_t>() != 0;
  cloud.point_step = bytes.count();
  cloud.row_step = bytes.count();
  const std::string_view data = bytes.sized();
  cloud.data = {reinterpret_cast<const std::uint8_t*>(data.data()), data.size()};
  return cloud;
}

bool is_depth_encoding(const std::string& encoding) {
  return encoding == "16UC1" || encoding == "mono16" || encoding == "32FC1";
}

Scan scan_of(const ImageMessage& image, const DepthImageOptions& options) {
  if (!is_depth_encoding(image.encoding)) {
    throw InputError("an image is '" + image.encoding +
                     "', depths are 16UC1 or mono16 (millimetres) or 32FC1 (metres)");
  }
  const bool is_metres = image.encoding == "32FC1";
  const std::uint64_t row_bytes =
      std::uint64_t{image.width} * (is_metres ? sizeof(float) : sizeof(std::uint16_t));
  const bool is_whole =
      image.height == 0 || image.width == 0 ||
      (image.step >= row_bytes &&
       image.data.size() >= std::uint64_t{image.height - 1} * image.step + row_bytes);
  if (!is_whole) {
    throw InputError("an image of " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels has " +
                     std::to_string(image.data.size()) + " bytes of data");
  }
  Scan scan;
  if (image.width == 0) return scan;
  const std::endian order = image.is_bigendian ? std::endian::big : std::endian::little;
  std::vector<std::uint16_t> depths(is_metres ? 0 : image.width);
  for (std::uint32_t row = 0; row < image.height; ++row) {
    const char* pixels = image.data.data() + std::uint64_t{row} * image.step;
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

}  // namespace nbvopt
