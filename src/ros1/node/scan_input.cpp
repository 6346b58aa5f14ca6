#include "ros1/node/scan_input.hpp"

#include <chrono>

#include "nbvopt/core/error.hpp"
#include "ros1/node/conversions.hpp"

namespace nbvopt {
namespace {

constexpr double kBetweenCloudWarnings_s = 5.0;

}  // namespace

ScanInput::ScanInput(ros::NodeHandle& node, const NodeParameters& parameters,
                     const tf2_ros::Buffer& tf, MapStore& store)
    : parameters_(parameters), tf_(tf), store_(store) {
  // A cloud that waits is replaced by a newer one.
  subscriber_ = node.subscribe("cloud_in", 1, &ScanInput::on_cloud, this);
}

void ScanInput::on_cloud(const sensor_msgs::PointCloud2& cloud) {
  const std::string& sensor_frame =
      parameters_.sensor_frame.empty() ? cloud.header.frame_id : parameters_.sensor_frame;
  try {
    Scan scan = scan_of(cloud);
    const Transform T_map_sensor =
        look_up(tf_, parameters_.map_frame, sensor_frame, cloud.header.stamp);
    if (sensor_frame != cloud.header.frame_id) {
      const Eigen::Isometry3f T_sensor_cloud =
          look_up(tf_, sensor_frame, cloud.header.frame_id, cloud.header.stamp).cast<float>();
      for (Eigen::Vector3f& p : scan.points_m) p = T_sensor_cloud * p;
    }
    const SensorOptions& sensor = parameters_.robot.sensor;
    if (const std::string doubt = none_in_range(count_scan(scan, sensor), sensor); !doubt.empty()) {
      ROS_WARN_THROTTLE(kBetweenCloudWarnings_s, "a cloud: %s", doubt.c_str());
    }
    const MapStore::Insertion inserted = store_.insert(scan, T_map_sensor);
    ROS_DEBUG("a cloud of %zu points gained %.1f", scan.points_m.size(),
              inserted.result.information_gained);
  } catch (const std::exception& error) {
    ROS_WARN_THROTTLE(kBetweenCloudWarnings_s, "a cloud is left out: %s", error.what());
    return;
  }
  const std::scoped_lock lock(mutex_);
  newest_ = std::max(newest_, cloud.header.stamp);
  has_scan_.notify_all();
}

bool ScanInput::wait_for_scan_since(const ros::Time& time, double timeout_s) {
  std::unique_lock lock(mutex_);
  return has_scan_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                            [&] { return newest_ >= time || !ros::ok(); });
}

}  // namespace nbvopt
