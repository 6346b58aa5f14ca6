// A URDF's links and joints from the base to the camera, as the file has them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/mast/urdf.hpp"

namespace nbvopt {

/// A joint between two links of the chain.
struct ChainJoint {
  enum class Motion { none, turns, slides };
  /// It follows another: value = multiplier * the other's + offset.
  struct Mimic {
    std::string joint;
    double multiplier = 1.0;
    double offset = 0.0;
  };

  std::string name;
  Motion motion = Motion::none;
  Transform T_parent_child = Transform::Identity();  ///< where the joint is at 0
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();    ///< unit, in the frame of the child
  double min = 0.0;                                  ///< rad or m; -inf without limits
  double max = 0.0;
  double velocity = 0.0;  ///< rad/s or m/s
  std::optional<Mimic> mimic;
  std::string child_link;
};

struct UrdfChain {
  std::string robot_name;
  std::string base_link;
  std::string camera_link;
  std::vector<ChainJoint> joints;  ///< from the base on
  std::vector<std::string> warnings;
};

/// Throws InputError "<name>: ..." for what is no URDF, for links that are not there or not above
/// each other, and for joints that are none of a mast's whatever their axes: floating, planar,
/// without a usable velocity. A joint whose limits are equal stands still.
UrdfChain read_urdf_chain(const std::string& text, const std::string& name,
                          const UrdfOptions& options);

}  // namespace nbvopt
