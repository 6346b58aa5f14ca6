#include "ros1/node/scan_input.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "ros1/node/conversions.hpp"

namespace nbvopt {
namespace {

constexpr double kBetweenScanWarnings_s = 5.0;

}  // namespace

ScanInput::ScanInput(ros::NodeHandle& node, const NodeParameters& parameters,
                     const tf2_ros::Buffer& tf, MapStore& store)
    : parameters_(parameters), tf_(tf), store_(store) {
  // A cloud that waits is replaced by a newer one.
  clouds_ = node.subscribe<sensor_msgs::PointCloud2>(
      "cloud_in", 1, [this](const sensor_msgs::PointCloud2::ConstPtr& cloud) {
        insert("a cloud", cloud->header.stamp, [&] { return posed(*cloud); });
      });
  subscribe_to_images(node);
}

void ScanInput::subscribe_to_images(ros::NodeHandle& node) {
  const std::string topic = node.resolveName("depth_in");
  const std::string info_topic = camera_info_beside(topic);
  constexpr const char* kImage = "an image";
  if (parameters_.image_transport == "raw") {
    images_.emplace(node, topic, info_topic,
                    [this](const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info) {
                      insert(kImage, image.header.stamp,
                             [&] { return posed(image_of(image), image.header, info); });
                    });
  } else {
    compressed_images_.emplace(
        node, topic + '/' + parameters_.image_transport, info_topic,
        [this](const sensor_msgs::CompressedImage& image, const sensor_msgs::CameraInfo& info) {
          insert(kImage, image.header.stamp, [&] {
            std::vector<std::uint8_t> bytes;
            return posed(unpack(image_of(image), bytes), image.header, info);
          });
        });
  }
}

PosedScan ScanInput::posed(const sensor_msgs::PointCloud2& cloud) const {
  const std::string& sensor_frame =
      parameters_.sensor_frame.empty() ? cloud.header.frame_id : parameters_.sensor_frame;
  Scan scan = scan_of(cloud);
  const Transform T_map_sensor =
      look_up(tf_, parameters_.map_frame, sensor_frame, cloud.header.stamp);
  if (sensor_frame != cloud.header.frame_id) {
    const Eigen::Isometry3f T_sensor_cloud =
        look_up(tf_, sensor_frame, cloud.header.frame_id, cloud.header.stamp).cast<float>();
    for (Eigen::Vector3f& p : scan.points_m) p = T_sensor_cloud * p;
  }
  return {.scan = std::move(scan), .T_map_sensor = T_map_sensor};
}

PosedScan ScanInput::posed(const ImageMessage& image, const std_msgs::Header& header,
                           const sensor_msgs::CameraInfo& info) const {
  const CameraInfoMessage camera = camera_info_of(info);
  check_image_size(image, camera);
  return {.scan = scan_of(image, depth_image_options(camera)),
          .T_map_sensor = look_up(tf_, parameters_.map_frame, header.frame_id, header.stamp)};
}

void ScanInput::insert(const char* what, const ros::Time& time,
                       const std::function<PosedScan()>& make) {
  try {
    const PosedScan posed = make();
    const SensorOptions& sensor = parameters_.robot.sensor;
    if (const std::string doubt = none_in_range(count_scan(posed.scan, sensor), sensor);
        !doubt.empty()) {
      ROS_WARN_THROTTLE(kBetweenScanWarnings_s, "%s: %s", what, doubt.c_str());
    }
    const MapStore::Insertion inserted = store_.insert(posed.scan, posed.T_map_sensor);
    ROS_DEBUG("%s of %zu points gained %.1f", what, posed.scan.points_m.size(),
              inserted.result.information_gained);
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(kBetweenScanWarnings_s, "%s is left out: %s", what, error.what());
    return;
  }
  const std::scoped_lock lock(mutex_);
  newest_ = std::max(newest_, time);
  has_scan_.notify_all();
}

bool ScanInput::wait_for_scan_since(const ros::Time& time, double timeout_s) {
  std::unique_lock lock(mutex_);
  return has_scan_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                            [&] { return newest_ >= time || !ros::ok(); });
}

}  // namespace nbvopt
