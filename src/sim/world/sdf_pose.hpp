// Gazebo's vectors and poses as ours.
#pragma once

#include <Eigen/Geometry>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>
#include <sdf/SemanticPose.hh>
#include <sdf/Types.hh>

namespace nbvopt {

inline Eigen::Vector3d vector_of(const ignition::math::Vector3d& v) {
  return {v.X(), v.Y(), v.Z()};
}

inline Eigen::Affine3d transform_of(const ignition::math::Pose3d& pose) {
  const ignition::math::Quaterniond& turn = pose.Rot();
  return Eigen::Translation3d(vector_of(pose.Pos())) *
         Eigen::Quaterniond(turn.W(), turn.X(), turn.Y(), turn.Z());
}

/// The pose of an element (model, link, visual, collision) in its parent. Where the frame that it
/// is given in is not known, which the document's faults tell, the numbers are taken as the
/// parent's.
template <class SdfElement>
Eigen::Affine3d T_parent(const SdfElement& element) {
  ignition::math::Pose3d pose;
  const sdf::Errors errors = element.SemanticPose().Resolve(pose);
  return transform_of(errors.empty() ? pose : element.RawPose());
}

}  // namespace nbvopt
