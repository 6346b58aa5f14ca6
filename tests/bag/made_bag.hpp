// Rosbags made by hand, byte by byte.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "map/append_number.hpp"
#include "nbvopt/core/transform.hpp"

namespace nbvopt::test {

inline std::string sized(const std::string& bytes) {
  std::string text;
  append(text, static_cast<std::uint32_t>(bytes.size()));
  return text + bytes;
}

template <class Number>
std::string bytes_of(const Number& number) {
  std::string bytes;
  append(bytes, number);
  return bytes;
}

using BagFields = std::vector<std::pair<std::string, std::string>>;

inline std::string bag_header(const BagFields& fields) {
  std::string header;
  for (const auto& [name, value] : fields) header += sized(name + "=" + value);
  return header;
}

inline std::string bag_record(char op, BagFields fields, const std::string& data) {
  fields.emplace_back("op", std::string(1, op));
  return sized(bag_header(fields)) + sized(data);
}

/// A bag of one chunk.
class MadeBag {
 public:
  void add(const std::string& topic, const std::string& type, const std::string& message) {
    const auto id = static_cast<std::uint32_t>(topics_.size());
    std::uint32_t found = 0;
    while (found < id && topics_[found] != topic) ++found;
    if (found == id) {
      topics_.push_back(topic);
      chunk_ += bag_record('\x07', {{"conn", bytes_of(id)}, {"topic", topic}},
                           bag_header({{"topic", topic}, {"type", type}}));
    }
    chunk_ +=
        bag_record('\x02', {{"conn", bytes_of(found)}, {"time", std::string(8, '\0')}}, message);
  }

  const std::string& chunk() const { return chunk_; }

  static std::string file_start() {
    return "#ROSBAG V2.0\n" +
           bag_record('\x03', {{"index_pos", std::string(8, '\0')}}, std::string(64, ' '));
  }

  /// `packed` is the chunk, packed as `compression` says.
  std::string file(const std::string& compression, const std::string& packed) const {
    const auto size = static_cast<std::uint32_t>(chunk_.size());
    return file_start() +
           bag_record('\x05', {{"compression", compression}, {"size", bytes_of(size)}}, packed);
  }
  std::string file() const { return file("none", chunk_); }

 private:
  std::vector<std::string> topics_;
  std::string chunk_;
};

inline std::string header_message(double time_s, const std::string& frame) {
  const auto seconds = static_cast<std::uint32_t>(time_s);
  const auto nanoseconds = static_cast<std::uint32_t>(1e9 * (time_s - seconds) + 0.5);
  return bytes_of(std::uint32_t{7}) + bytes_of(seconds) + bytes_of(nanoseconds) + sized(frame);
}

inline std::string tf_message(double time_s, const std::string& parent, const std::string& child,
                              const Transform& T) {
  const Eigen::Quaterniond q(T.rotation());
  std::string message = bytes_of(std::uint32_t{1}) + header_message(time_s, parent) + sized(child);
  for (const double number : {T.translation().x(), T.translation().y(), T.translation().z(), q.x(),
                              q.y(), q.z(), q.w()}) {
    append(message, number);
  }
  return message;
}

inline std::string cloud_message(double time_s, const std::string& frame,
                                 const std::vector<Eigen::Vector3f>& points_m) {
  std::string message = header_message(time_s, frame) + bytes_of(std::uint32_t{1});
  append(message, static_cast<std::uint32_t>(points_m.size()));
  append(message, std::uint32_t{3});
  for (std::uint32_t i = 0; i < 3; ++i) {
    message += sized(std::string(1, "xyz"[i])) + bytes_of(4 * i) + '\x07' + bytes_of(1U);
  }
  const std::string data(reinterpret_cast<const char*>(points_m.data()),
                         points_m.size() * sizeof(Eigen::Vector3f));
  return message + '\0' + bytes_of(12U) + bytes_of(static_cast<std::uint32_t>(data.size())) +
         sized(data) + '\1';
}

inline std::string image_message(double time_s, const std::string& frame, std::uint32_t width,
                                 std::uint32_t height, const std::string& encoding,
                                 const std::string& data, bool is_bigendian = false) {
  const auto step = static_cast<std::uint32_t>(data.size() / height);
  return header_message(time_s, frame) + bytes_of(height) + bytes_of(width) + sized(encoding) +
         (is_bigendian ? '\1' : '\0') + bytes_of(step) + sized(data);
}

inline std::string compressed_image_message(double time_s, const std::string& frame,
                                            const std::string& format, const std::string& data) {
  return header_message(time_s, frame) + sized(format) + sized(data);
}

/// By P, or by K alone, of an image that was not rectified.
inline std::string camera_info_message(double time_s, const std::string& frame, double focal_px,
                                       double cx_px, double cy_px, bool is_rectified = true) {
  std::string message = header_message(time_s, frame) + bytes_of(3U) + bytes_of(4U) +
                        sized("plumb_bob") + bytes_of(0U);
  const auto zeros = [&message](int count) {
    for (int i = 0; i < count; ++i) append(message, 0.0);
  };
  const auto numbers = [&message](const std::vector<double>& all) {
    for (const double number : all) append(message, number);
  };
  if (is_rectified) {
    zeros(9 + 9);  // K and R
    numbers({focal_px, 0.0, cx_px, 0.0, 0.0, focal_px, cy_px, 0.0, 0.0, 0.0, 1.0, 0.0});
  } else {
    numbers({focal_px, 0.0, cx_px, 0.0, focal_px, cy_px, 0.0, 0.0, 1.0});
    zeros(9 + 12);
  }
  return message + std::string(4 + 4 + 17, '\0');
}

}  // namespace nbvopt::test
