// Between messages of poses, joints and velocities and the library's own types, both ways.
//
// What comes from a message is checked: a needed field that is not set, a number that is not finite
// and records that are cut short are refused with an InputError that names the field.
#pragma once

#include <string>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/mast/mast.hpp"
#include "nbvopt/mast/moving_mast.hpp"
#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

/// `field` names the message in errors, here and below.
Transform from_message(const v1::Pose& pose, const std::string& field);
Transform from_message(const v1::BasePose& base, const std::string& field);
JointPosition from_message(const v1::JointPosition& joints, const std::string& field);
BaseTwist from_message(const v1::BaseTwist& twist, const std::string& field);

/// T_map_sensor of a view; `mast` turns joints into poses.
Transform from_message(const v1::View& view, const Mast& mast, const std::string& field);

v1::Pose to_message(const Transform& T);
v1::JointPosition to_message(const JointPosition& joints);

}  // namespace nbvopt
