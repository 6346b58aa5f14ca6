#include "ros1/node/joints.hpp"

#include <std_msgs/Float64.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>
#include <cmath>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

Joints::Joints(ros::NodeHandle& node, const NodeParameters& parameters) : parameters_(parameters) {
  trajectory_ =
      node.advertise<trajectory_msgs::JointTrajectory>("/sensor_trajectory_controller/command", 1);
  pan_ = node.advertise<std_msgs::Float64>(
      "/telescopic_arm_continuous_joint_position_controller/command", 1);
  constexpr int kQueue = 10;  // several drivers may publish their joints apart
  subscriber_ = node.subscribe("joint_states", kQueue, &Joints::on_states, this);
}

void Joints::on_states(const sensor_msgs::JointState& states) {
  const std::scoped_lock lock(mutex_);
  bool is_ours = false;
  for (std::size_t i = 0; i < states.name.size() && i < states.position.size(); ++i) {
    for (std::size_t j = 0; j < ros_positions_.size(); ++j) {
      const auto& joint = parameters_.joints[j];
      if (!joint || joint->name != states.name[i] || !std::isfinite(states.position[i])) continue;
      ros_positions_[j] = states.position[i];
      is_ours = true;
    }
  }
  if (!is_ours) return;
  stamp_ = states.header.stamp;
  has_moved_.notify_all();
}

std::string Joints::missing() const {
  for (std::size_t j = 0; j < ros_positions_.size(); ++j) {
    if (parameters_.joints[j] && !ros_positions_[j]) return parameters_.joints[j]->name;
  }
  return "";
}

JointPosition Joints::positions() const {
  const MastOptions& mast = parameters_.robot.mast;
  Eigen::Vector3d q(mast.pan_min_rad, mast.tilt_min_rad, mast.height_min_m);
  for (int j = 0; j < q.size(); ++j) {
    const auto& joint = parameters_.joints[static_cast<std::size_t>(j)];
    if (joint) q[j] = joint->offset + joint->scale * *ros_positions_[static_cast<std::size_t>(j)];
  }
  return JointPosition::from(q);
}

JointPosition Joints::now() const {
  const std::scoped_lock lock(mutex_);
  if (const std::string name = missing(); !name.empty()) {
    throw InputError("joint_states has not told of the joint '" + name + "'");
  }
  return positions();
}

void Joints::move_to(const JointPosition& target, double move_time_s) {
  trajectory_msgs::JointTrajectory trajectory;  // a stamp of zero: the motion starts at once
  trajectory_msgs::JointTrajectoryPoint point;
  point.time_from_start = ros::Duration(move_time_s);
  const Eigen::Vector3d q = target.vector();
  for (int j = 0; j < q.size(); ++j) {
    const auto& joint = parameters_.joints[static_cast<std::size_t>(j)];
    if (!joint) continue;
    trajectory.joint_names.push_back(joint->name);
    point.positions.push_back((q[j] - joint->offset) / joint->scale);
  }
  if (const auto& pan = parameters_.joints[0]) {
    std_msgs::Float64 command;
    command.data = (target.pan_rad - pan->offset) / pan->scale;
    pan_.publish(command);
  }
  trajectory.points.push_back(point);
  trajectory_.publish(trajectory);
}

bool Joints::is_at(const JointPosition& target) const {
  const Eigen::Vector3d way = positions().vector() - target.vector();
  const double pan_rad = parameters_.robot.mast.pan_continuous ? wrap_angle(way[0]) : way[0];
  return std::abs(pan_rad) <= parameters_.arrival_angle_rad &&
         std::abs(way[1]) <= parameters_.arrival_angle_rad &&
         std::abs(way[2]) <= parameters_.arrival_height_m;
}

std::optional<ros::Time> Joints::wait_until_at(const JointPosition& target, double timeout_s) {
  std::unique_lock lock(mutex_);
  const bool is_there = has_moved_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                                            [&] { return is_at(target) || !ros::ok(); });
  if (!is_there || !ros::ok()) return std::nullopt;
  return stamp_;
}

}  // namespace nbvopt
