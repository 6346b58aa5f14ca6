#include "bag/ros_messages.hpp"

#include <array>

#include "map/byte_reader.hpp"
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
  std::span<const std::uint8_t> sized_data() {
    const std::string_view data = sized();
    return {reinterpret_cast<const std::uint8_t*>(data.data()), data.size()};
  }
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

}  // namespace

MessageHeader parse_header(std::string_view message) {
  Bytes bytes(message);
  return take_header(bytes);
}

CameraInfoMessage parse_camera_info(std::string_view message) {
  Bytes bytes(message);
  take_header(bytes);
  CameraInfoMessage info;
  info.height = bytes.count();
  info.width = bytes.count();
  bytes.sized();                                                // the distortion's model
  bytes.take(bytes.count_of(sizeof(double)) * sizeof(double));  // its parameters
  info.K = take_doubles<9>(bytes);
  take_doubles<9>(bytes);  // the rectifying rotation
  info.P = take_doubles<12>(bytes);
  return info;
}

ImageMessage parse_image(std::string_view message) {
  Bytes bytes(message);
  take_header(bytes);
  ImageMessage image;
  image.height = bytes.count();
  image.width = bytes.count();
  image.encoding = bytes.text();
  image.is_bigendian = bytes.number<std::uint8_t>() != 0;
  image.step = bytes.count();
  image.data = bytes.sized_data();
  return image;
}

CompressedImageMessage parse_compressed_image(std::string_view message) {
  Bytes bytes(message);
  take_header(bytes);
  CompressedImageMessage image;
  image.format = bytes.text();
  image.data = bytes.sized_data();
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

PointCloudMessage parse_point_cloud(std::string_view message) {
  Bytes bytes(message);
  take_header(bytes);
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
  cloud.data = bytes.sized_data();
  return cloud;
}

}  // namespace nbvopt
