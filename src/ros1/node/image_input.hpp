// The images of a camera, each with what the camera says of itself.
#pragma once

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>

#include <functional>
#include <string>
#include <utility>

namespace nbvopt {

/// Subscribes to the images of a topic and to its camera_info, and hands on those of one stamp. An
/// image whose camera_info does not come is left out, and the log says so.
template <class Image>
class ImageInput {
 public:
  using OnImage = std::function<void(const Image& image, const sensor_msgs::CameraInfo& info)>;

  ImageInput(ros::NodeHandle& node, const std::string& image_topic, const std::string& info_topic,
             OnImage on_image)
      : on_image_(std::move(on_image)),
        info_topic_(info_topic),
        images_(node, image_topic, 1),  // one that waits is replaced by a newer one
        infos_(node, info_topic, kQueue),
        pairs_(images_, infos_, kQueue) {
    pairs_.registerCallback(&ImageInput::on_pair, this);
    pairs_.registerDropCallback(&ImageInput::on_drop, this);
  }

 private:
  using ImagePtr = typename Image::ConstPtr;
  using InfoPtr = sensor_msgs::CameraInfo::ConstPtr;

  void on_pair(const ImagePtr& image, const InfoPtr& info) { on_image_(*image, *info); }

  void on_drop(const ImagePtr& image, const InfoPtr&) {
    constexpr double kBetweenWarnings_s = 5.0;
    if (image == nullptr) return;
    ROS_WARN_THROTTLE(kBetweenWarnings_s,
                      "an image is left out: no camera_info of its stamp has come on %s",
                      info_topic_.c_str());
  }

  static constexpr std::uint32_t kQueue = 30;  ///< while an image is put into the map

  OnImage on_image_;
  std::string info_topic_;
  message_filters::Subscriber<Image> images_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> infos_;
  message_filters::TimeSynchronizer<Image, sensor_msgs::CameraInfo> pairs_;
};

}  // namespace nbvopt
