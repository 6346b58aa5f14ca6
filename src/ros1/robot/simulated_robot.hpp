// A robot in a simulated world, behind the topics that a real one has.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <tf2_ros/transform_broadcaster.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <array>
#include <cstdint>
#include <optional>

#include "nbvopt/mast/mast.hpp"
#include "nbvopt/sim/simulated_camera.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "ros1/node/parameters.hpp"

namespace nbvopt {

/// Publishes clouds, joint_states and tf, and moves its joints as it is told to, each at its own
/// velocity. The base stands at the trajectory's start until the first command, then follows it.
class SimulatedRobot {
 public:
  SimulatedRobot(ros::NodeHandle& node, const NodeParameters& parameters, const Scene& scene,
                 const Trajectory& trajectory, double camera_hz);

 private:
  void on_trajectory(const trajectory_msgs::JointTrajectory& command);
  void on_pan(const std_msgs::Float64& command);
  void move_to(const JointPosition& target);
  JointPosition joints_at(const ros::Time& time) const;
  Transform T_map_base(const ros::Time& time) const;

  /// Tells where base, joints and camera are at that time.
  void publish_state(const ros::Time& time);
  void publish_cloud();

  const NodeParameters& parameters_;
  const Trajectory& trajectory_;
  Mast mast_;
  SimulatedCamera camera_;
  std::uint64_t frame_ = 0;
  JointPosition from_, to_;  ///< of the newest motion
  ros::Time departure_;
  std::optional<ros::Time> drive_start_;
  tf2_ros::TransformBroadcaster tf_;
  ros::Publisher joint_states_, cloud_;
  std::array<ros::Subscriber, 2> commands_;
  std::array<ros::Timer, 2> timers_;
};

}  // namespace nbvopt
