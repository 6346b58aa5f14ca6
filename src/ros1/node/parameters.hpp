// The node's parameters, by the names that the paper's released nodes give them.
#pragma once

#include <ros/node_handle.h>

#include <array>
#include <optional>
#include <string>

#include "nbvopt/map/floor_plan.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt {

/// A joint that the node moves; the mast's value is offset + scale * the joint's.
using RosJoint = UrdfJoint;

struct NodeParameters {
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::string sensor_frame;  ///< optical (z forward, x right, y down); empty: that of each cloud
  std::string image_transport = "raw";  ///< of depth images; or compressedDepth, compressed
  Robot robot;
  /// (pan, tilt, height); none: it stays where the robot's limits, which are equal, have it.
  std::array<std::optional<RosJoint>, 3> joints;
  std::string map_file;             ///< to begin with; empty: an empty map
  double resolution_m = 0.1;        ///< of an empty map
  double time_limit_ms = 500.0;     ///< of a search
  double arrival_timeout_s = 2.0;   ///< after the motion's own time; 0: nobody waits for the joints
  double arrival_angle_rad = 0.02;  ///< a joint this near has arrived
  double arrival_height_m = 0.01;
  double path_speed_m_s = 0.0;    ///< along a path whose poses tell no times; 0: it is not heeded
  double publish_period_s = 1.0;  ///< of the map
  bool publishes_free_space = false;
  HeightBand shown_band;  ///< of cubes, their centres and projected_map
};

/// Reads the private parameters. Throws InputError that names the parameter and its value.
NodeParameters read_parameters(const ros::NodeHandle& node);

}  // namespace nbvopt
