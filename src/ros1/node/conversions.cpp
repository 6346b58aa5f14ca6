#include "ros1/node/conversions.hpp"

#include <algorithm>

#include "map/point_cloud_message.hpp"

namespace nbvopt {

Transform transform_of(const geometry_msgs::Transform& message) {
  const auto& p = message.translation;
  const auto& q = message.rotation;
  return pose_from_quaternion({p.x, p.y, p.z}, {q.x, q.y, q.z, q.w});
}

Transform transform_of(const geometry_msgs::Pose& message) {
  const auto& p = message.position;
  const auto& q = message.orientation;
  return pose_from_quaternion({p.x, p.y, p.z}, {q.x, q.y, q.z, q.w});
}

geometry_msgs::Pose pose_message(const Transform& transform) {
  const Eigen::Quaterniond q(transform.rotation());
  geometry_msgs::Pose message;
  message.position = point_message(transform.translation());
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  message.orientation.w = q.w();
  return message;
}

geometry_msgs::Transform transform_message(const Transform& transform) {
  const geometry_msgs::Pose pose = pose_message(transform);
  geometry_msgs::Transform message;
  message.translation.x = pose.position.x;
  message.translation.y = pose.position.y;
  message.translation.z = pose.position.z;
  message.rotation = pose.orientation;
  return message;
}

geometry_msgs::Point point_message(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

Eigen::Vector3d point_of(const geometry_msgs::Point& message) {
  return {message.x, message.y, message.z};
}

Transform look_up(const tf2_ros::Buffer& tf, const std::string& to, const std::string& from,
                  const ros::Time& time) {
  constexpr double kTimeout_s = 0.2;
  return transform_of(tf.lookupTransform(to, from, time, ros::Duration(kTimeout_s)).transform);
}

sensor_msgs::PointCloud2 cloud_of_floats(std::initializer_list<const char*> fields) {
  sensor_msgs::PointCloud2 cloud;
  for (const char* name : fields) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud.point_step;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += sizeof(float);
  }
  return cloud;
}

ImageMessage image_of(const sensor_msgs::Image& message) {
  return {.height = message.height,
          .width = message.width,
          .encoding = message.encoding,
          .is_bigendian = message.is_bigendian != 0,
          .step = message.step,
          .data = message.data};
}

CompressedImageMessage image_of(const sensor_msgs::CompressedImage& message) {
  return {.format = message.format, .data = message.data};
}

CameraInfoMessage camera_info_of(const sensor_msgs::CameraInfo& message) {
  CameraInfoMessage info{.height = message.height, .width = message.width};
  std::ranges::copy(message.K, info.K.begin());
  std::ranges::copy(message.P, info.P.begin());
  return info;
}

Scan scan_of(const sensor_msgs::PointCloud2& message) {
  PointCloudMessage cloud{.height = message.height,
                          .width = message.width,
                          .fields = {},
                          .is_bigendian = message.is_bigendian != 0,
                          .point_step = message.point_step,
                          .row_step = message.row_step,
                          .data = message.data};
  for (const auto& field : message.fields) {
    cloud.fields.push_back({field.name, field.offset, field.datatype, field.count});
  }
  return scan_of(cloud);
}

}  // namespace nbvopt
