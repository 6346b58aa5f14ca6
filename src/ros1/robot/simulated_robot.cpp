#include "ros1/robot/simulated_robot.hpp"

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <vector>

#include "ros1/node/conversions.hpp"

namespace nbvopt {
namespace {

constexpr double kStateHz = 50.0;
constexpr JointPosition kStart{.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4};

/// A driver has no point for what is too far: ours puts one beyond the range, which clears the ray.
sensor_msgs::PointCloud2 cloud_message(const Scan& scan, double range_max_m) {
  sensor_msgs::PointCloud2 cloud = cloud_of_floats({"x", "y", "z"});
  std::vector<Eigen::Vector3f> points = scan.points_m;
  for (const Eigen::Vector3f& direction : scan.no_returns) {
    points.emplace_back(direction * static_cast<float>(2.0 * range_max_m));
  }
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.row_step = cloud.width * cloud.point_step;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(points.data());
  cloud.data.assign(bytes, bytes + cloud.row_step);
  return cloud;
}

}  // namespace

SimulatedRobot::SimulatedRobot(ros::NodeHandle& node, const NodeParameters& parameters,
                               const Scene& scene, const Trajectory& trajectory, double camera_hz)
    : parameters_(parameters),
      trajectory_(trajectory),
      mast_(parameters.robot.mast),
      camera_(scene, parameters.robot.sensor, 0.0, 1) {
  const MastOptions& mast = mast_.options();
  from_ = {.pan_rad = mast.pan_continuous
                          ? kStart.pan_rad
                          : std::clamp(kStart.pan_rad, mast.pan_min_rad, mast.pan_max_rad),
           .tilt_rad = std::clamp(kStart.tilt_rad, mast.tilt_min_rad, mast.tilt_max_rad),
           .height_m = std::clamp(kStart.height_m, mast.height_min_m, mast.height_max_m)};
  to_ = from_;
  departure_ = ros::Time::now();
  joint_states_ = node.advertise<sensor_msgs::JointState>("joint_states", 1);
  cloud_ = node.advertise<sensor_msgs::PointCloud2>("cloud_in", 1);
  commands_ = {node.subscribe("/sensor_trajectory_controller/command", 1,
                              &SimulatedRobot::on_trajectory, this),
               node.subscribe("/telescopic_arm_continuous_joint_position_controller/command", 1,
                              &SimulatedRobot::on_pan, this)};
  timers_ = {node.createTimer(ros::Duration(1.0 / kStateHz),
                              [this](const ros::TimerEvent&) { publish_state(ros::Time::now()); }),
             node.createTimer(ros::Duration(1.0 / camera_hz),
                              [this](const ros::TimerEvent&) { publish_cloud(); })};
}

void SimulatedRobot::on_trajectory(const trajectory_msgs::JointTrajectory& command) {
  if (command.points.empty()) return;
  const auto& positions = command.points.back().positions;
  Eigen::Vector3d target = to_.vector();
  for (std::size_t i = 0; i < command.joint_names.size() && i < positions.size(); ++i) {
    for (std::size_t j = 0; j < parameters_.joints.size(); ++j) {
      const auto& joint = parameters_.joints[j];
      if (!joint || joint->name != command.joint_names[i]) continue;
      target[static_cast<int>(j)] = joint->offset + joint->scale * positions[i];
    }
  }
  move_to(JointPosition::from(target));
}

void SimulatedRobot::on_pan(const std_msgs::Float64& command) {
  const auto& pan = parameters_.joints[0];
  if (!pan) return;
  JointPosition target = to_;
  target.pan_rad = pan->offset + pan->scale * command.data;
  move_to(target);
}

void SimulatedRobot::move_to(const JointPosition& target) {
  const ros::Time now = ros::Time::now();
  from_ = joints_at(now);
  to_ = target;
  departure_ = now;
  if (!drive_start_) drive_start_ = now;
}

JointPosition SimulatedRobot::joints_at(const ros::Time& time) const {
  return mast_.on_the_way(from_, to_, std::max(0.0, (time - departure_).toSec()));
}

Transform SimulatedRobot::T_map_base(const ros::Time& time) const {
  return trajectory_.T_map_base(drive_start_ ? (time - *drive_start_).toSec() : 0.0);
}

void SimulatedRobot::publish_state(const ros::Time& time) {
  const JointPosition joints = joints_at(time);
  geometry_msgs::TransformStamped base, sensor;
  base.header.stamp = sensor.header.stamp = time;
  base.header.frame_id = parameters_.map_frame;
  base.child_frame_id = sensor.header.frame_id = parameters_.base_frame;
  sensor.child_frame_id = parameters_.sensor_frame;
  base.transform = transform_message(T_map_base(time));
  sensor.transform = transform_message(mast_.T_base_sensor(joints));
  tf_.sendTransform(std::vector{base, sensor});

  sensor_msgs::JointState state;
  state.header.stamp = time;
  const Eigen::Vector3d q = joints.vector();
  for (int j = 0; j < q.size(); ++j) {
    const auto& joint = parameters_.joints[static_cast<std::size_t>(j)];
    if (!joint) continue;
    state.name.push_back(joint->name);
    state.position.push_back((q[j] - joint->offset) / joint->scale);
  }
  joint_states_.publish(state);
}

void SimulatedRobot::publish_cloud() {
  const ros::Time time = ros::Time::now();
  publish_state(time);
  const Transform T_map_sensor = T_map_base(time) * mast_.T_base_sensor(joints_at(time));
  sensor_msgs::PointCloud2 cloud =
      cloud_message(camera_.capture(T_map_sensor, frame_++), parameters_.robot.sensor.range_max_m);
  cloud.header.stamp = time;
  cloud.header.frame_id = parameters_.sensor_frame;
  cloud_.publish(cloud);
}

}  // namespace nbvopt
