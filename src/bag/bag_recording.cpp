#include "bag/bag_recording.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "bag/ros_messages.hpp"
#include "bag/tf_history.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr const char* kCloud = "sensor_msgs/PointCloud2";
constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCompressedImage = "sensor_msgs/CompressedImage";
constexpr const char* kCameraInfo = "sensor_msgs/CameraInfo";

bool is_tf(const std::string& type) {
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Of the images of a topic, whose transport may have added its own name to it.
std::string camera_info_topic(const std::string& image_topic, const std::string& type) {
  return camera_info_beside(type == kCompressedImage ? image_topic.substr(0, image_topic.rfind('/'))
                                                     : image_topic);
}

}  // namespace

/// What is found on the way through the bag.
class BagRecording::Survey {
 public:
  explicit Survey(const BagOptions& options) : options_(options) {}

  void take(const BagConnection& connection, std::string_view message, const BagPosition& where) {
    if (is_tf(connection.type)) {
      const bool is_static = connection.topic.ends_with("tf_static");
      for (const TransformMessage& told : parse_transforms(message)) {
        tf_.add(told.header.frame, told.child_frame, told.header.time_s, told.T_frame_child,
                is_static);
      }
    } else if (connection.type == kCameraInfo) {
      cameras_.emplace(connection.topic, parse_camera_info(message));  // the first: it stays
    } else if (connection.type == kCloud || connection.type == kImage ||
               connection.type == kCompressedImage) {
      take_frame(connection, message, where);
    }
  }

  void finish() { tf_.finish(); }

  struct FoundFrame {
    BagPosition where;
    MessageHeader header;
  };
  struct Topic {
    std::string type;
    std::vector<FoundFrame> frames;
  };

  /// The topic of the frames. Throws InputError that lists what there is.
  std::pair<const std::string, Topic>& chosen(const std::string& bag) {
    if (const auto found = topics_.find(options_.topic); found != topics_.end()) return *found;
    if (options_.topic.empty() && topics_.size() == 1) return *topics_.begin();
    std::vector<std::string> list;
    for (const auto& [topic, what] : topics_) {
      list.push_back(topic + " (" + what.type + ", " + std::to_string(what.frames.size()) + ")");
    }
    if (topics_.empty()) {
      throw InputError(bag + ": has no topic of " + std::string(kCloud) + " or of depth images (" +
                       kImage + ", " + kCompressedImage + ")" +
                       (encodings_.empty() ? ""
                                           : ", its images are " +
                                                 joined({encodings_.begin(), encodings_.end()})));
    }
    if (options_.topic.empty()) {
      throw InputError(bag + ": has several topics of clouds or depth images, choose one by " +
                       "topic: " + joined(list));
    }
    throw InputError(bag + ": has no clouds or depth images on the topic '" + options_.topic +
                     "', but on " + joined(list));
  }

  /// That of the camera, or nothing where its intrinsics are given. `type` is that of the images.
  std::optional<CameraInfoMessage> camera_info(const std::string& bag, const std::string& topic,
                                               const std::string& type) const {
    if (options_.fx_fy_cx_cy_px) return std::nullopt;
    const std::string& named = options_.camera_info_topic;
    const std::string looked_for = named.empty() ? camera_info_topic(topic, type) : named;
    const auto found = cameras_.find(looked_for);
    if (found != cameras_.end()) return found->second;
    if (named.empty() && cameras_.size() == 1) return cameras_.begin()->second;
    std::vector<std::string> list;
    for (const auto& [camera, unused] : cameras_) list.push_back(camera);
    throw InputError(
        bag + ": has no camera_info on '" + looked_for + "'" +
        (list.empty() ? ", give the camera's intrinsics" : ", but on " + joined(list)));
  }

  DepthImageOptions depth_image(const std::optional<CameraInfoMessage>& info) const {
    DepthImageOptions image;
    if (info) {
      image = depth_image_options(*info);
    } else {
      const auto [fx, fy, cx, cy] = *options_.fx_fy_cx_cy_px;
      image.fx_px = fx;
      image.fy_px = fy;
      image.cx_px = cx;
      image.cy_px = cy;
    }
    image.depth_scale_m = options_.depth_scale_m.value_or(image.depth_scale_m);
    image.largest_value = options_.largest_value.value_or(image.largest_value);
    image.validate();
    return image;
  }

  const TfHistory& tf() const { return tf_; }

 private:
  void take_frame(const BagConnection& connection, std::string_view message,
                  const BagPosition& where) {
    if (connection.type != kCloud) {
      const std::string encoding = connection.type == kImage
                                       ? parse_image(message).encoding
                                       : encoding_of(parse_compressed_image(message));
      if (!is_depth_encoding(encoding) && connection.topic != options_.topic) {
        encodings_.insert("'" + encoding + "'");
        return;
      }
    }
    Topic& topic = topics_[connection.topic];
    topic.type = connection.type;
    topic.frames.push_back({where, parse_header(message)});
  }

  const BagOptions& options_;
  TfHistory tf_;
  std::map<std::string, CameraInfoMessage> cameras_;
  std::map<std::string, Topic> topics_;
  std::set<std::string> encodings_;  ///< of images that are no depths
};

BagRecording::BagRecording(const std::filesystem::path& path, const BagOptions& options)
    : name_(path.string()), bag_(path) {
  Survey survey(options);
  bag_.for_each_message(
      [&](const BagConnection& connection, std::string_view message, const BagPosition& where) {
        try {
          survey.take(connection, message, where);
        } catch (const InputError& error) {
          throw InputError(name_ + ": the topic '" + connection.topic + "' (" + connection.type +
                           "): " + error.what());
        }
      });
  survey.finish();
  auto& [topic, found] = survey.chosen(name_);
  summary_.topic = topic;
  summary_.type = found.type;
  if (found.type != kCloud) {
    camera_info_ = survey.camera_info(name_, topic, found.type);
    depth_image_ = survey.depth_image(camera_info_);
  }

  const TfHistory& tf = survey.tf();
  summary_.sensor_frame = found.frames.front().header.frame;
  const bool is_optical = summary_.sensor_frame.find("optical") != std::string::npos;
  axes_ = depth_image_ ? PoseAxes::optical
                       : options.axes.value_or(is_optical ? PoseAxes::optical : PoseAxes::body);
  summary_.fixed_frame =
      options.fixed_frame.empty() ? tf.root_of(summary_.sensor_frame) : options.fixed_frame;
  for (const Survey::FoundFrame& frame : found.frames) {
    const auto T_fixed_frame = tf.look_up(summary_.fixed_frame, frame.header.frame,
                                          frame.header.time_s, options.max_time_difference_s);
    if (T_fixed_frame) {
      frames_.push_back({frame.where, frame.header.time_s, *T_fixed_frame});
    } else {
      ++summary_.frames_without_pose;
    }
  }
  if (tf.empty()) throw InputError(name_ + ": holds no tf, so nobody knows where the camera was");
  if (frames_.empty()) {
    throw InputError(name_ + ": tf leads from '" + summary_.sensor_frame + "' to '" +
                     summary_.fixed_frame + "' at the time of none of the " +
                     std::to_string(summary_.frames_without_pose) + " frames; it knows " +
                     joined(tf.frames()));
  }
}

PosedScan BagRecording::read(std::uint64_t frame) {
  const Frame& found = frames_.at(frame);
  try {
    const std::string_view message = bag_.message_at(found.where);
    PosedScan posed{.scan = {}, .T_map_sensor = found.T_fixed_frame};
    if (depth_image_) {
      std::vector<std::uint8_t> bytes;
      const ImageMessage image = summary_.type == kImage
                                     ? parse_image(message)
                                     : unpack(parse_compressed_image(message), bytes);
      if (camera_info_) check_image_size(image, *camera_info_);
      posed.scan = scan_of(image, *depth_image_);
    } else {
      posed.scan = scan_of(parse_point_cloud(message));
      posed.T_map_sensor = found.T_fixed_frame * to_optical_axes(axes_, posed.scan);
    }
    return posed;
  } catch (const InputError& error) {
    throw InputError(name(frame) + ": " + error.what());
  }
}

std::string BagRecording::name(std::uint64_t frame) const {
  return name_ + ", " + summary_.topic + " at " + format_number(frames_.at(frame).time_s) + " s";
}

void BagRecording::identify(const std::function<void(std::string_view)>& add) const {
  add(summary_.topic);
  add(to_string(axes_));
  if (depth_image_) {
    for (const double number : {depth_image_->fx_px, depth_image_->fy_px, depth_image_->cx_px,
                                depth_image_->cy_px, depth_image_->depth_scale_m}) {
      add(format_number(number));
    }
    add(to_string(depth_image_->largest_value));
  }
  for (const Frame& frame : frames_) {
    add(format_number(frame.time_s));
    for (const double number : frame.T_fixed_frame.matrix().reshaped()) add(format_number(number));
  }
}

}  // namespace nbvopt
