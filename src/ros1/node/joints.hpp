// The joints of the mast, as their driver tells and takes them.
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <array>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "nbvopt/mast/mast.hpp"
#include "ros1/node/parameters.hpp"

namespace nbvopt {

/// Keeps the newest of joint_states, and publishes where the joints are to go: all of them on
/// /sensor_trajectory_controller/command, the pan alone on the paper's
/// /telescopic_arm_continuous_joint_position_controller/command.
class Joints {
 public:
  Joints(ros::NodeHandle& node, const NodeParameters& parameters);

  /// Where they are. Throws InputError that names a joint that nobody has told of.
  JointPosition now() const;

  /// Sends them there within that time.
  void move_to(const JointPosition& target, double move_time_s);

  /// Waits until all have arrived, and tells when; none: they had not in so many seconds.
  std::optional<ros::Time> wait_until_at(const JointPosition& target, double timeout_s);

 private:
  void on_states(const sensor_msgs::JointState& states);
  std::string missing() const;  ///< a joint's name; empty: there is none
  JointPosition positions() const;
  bool is_at(const JointPosition& target) const;

  const NodeParameters& parameters_;
  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable has_moved_;
  std::array<std::optional<double>, 3> ros_positions_;  ///< of the joints, not of the mast
  ros::Time stamp_;
  ros::Publisher trajectory_, pan_;
  ros::Subscriber subscriber_;  ///< the last member: its calls end before the others go
};

}  // namespace nbvopt
