// Pose files: JSON with a `sensor` block and `cases`, each the pose of one view.
#pragma once

#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/planner/robot.hpp"

namespace nbvopt {

struct PoseFile {
  SensorOptions sensor;
  std::vector<Transform> poses_T_map_sensor;  ///< one a case, in the file's order
};

/// Reads a pose file from its text; `name` stands for the file in messages.
///
/// `sensor` has the keys of the robot file's sensor block and overrides those of `robot`. A case
/// is the optical frame's `position` and `orientation_xyzw` or, where it has neither, a `base`
/// {x, y, yaw, and z unless 0} with `pan`, `tilt` and `height` of the robot's mast, whose limits
/// do not bind. Other keys of cases and of the file are ignored, such as recorded gains.
/// Throws InputError that names the file and the line, the case and its field.
PoseFile parse_pose_file(const std::string& json, const std::string& name, const Robot& robot);

}  // namespace nbvopt
