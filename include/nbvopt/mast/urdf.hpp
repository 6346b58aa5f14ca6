// The mast that a URDF describes: the chain of joints from the base to the camera.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nbvopt/mast/mast.hpp"

namespace nbvopt {

/// The axes of a camera's link (REP 103): optical is z forward, x right, y down; body is x forward,
/// y left, z up.
enum class CameraAxes { optical, body };
std::string to_string(CameraAxes value);

/// What a URDF does not say.
struct UrdfOptions {
  std::string camera_link;  ///< whose origin is the optical centre
  std::string base_link;    ///< z up, x forward; empty: the root of the tree
  /// None: optical where the link's name has "optical" in it, else body.
  std::optional<CameraAxes> camera_axes{};

  bool operator==(const UrdfOptions&) const = default;
};

/// A joint of the URDF that moves the mast: the mast's value is offset + scale * the joint's.
struct UrdfJoint {
  std::string name;
  double scale = 1.0;   ///< -1 or 1; of a lift with stages that mimic one, what all lift together
  double offset = 0.0;  ///< rad or m
};

/// What was understood of a URDF.
struct UrdfMast {
  std::string robot_name;
  std::string base_link;
  std::string camera_link;
  CameraAxes camera_axes = CameraAxes::body;
  MastOptions mast;
  std::array<std::optional<UrdfJoint>, 3> joints;  ///< (pan, tilt, height); none: it is fixed
  std::vector<std::string> warnings;               ///< what was taken for something close to it
};

/// Whether a robot's file is XML, as a URDF is, and not YAML.
bool is_xml(std::string_view text);

/// Reads the chain from base to camera. A vertical joint is the pan, a horizontal one to the
/// camera's left or right the tilt, vertical prismatic ones the height, wherever the frames of
/// links between them lie, as long as Mast::T_base_sensor() can be what the chain is. Numbers
/// that were added are rounded to 1e-12, so that decimals stay decimals. Angles off by at most
/// 0.002 rad (1.57 for a right one) and axes by 1 mm are taken for what they mean.
///
/// Throws InputError with `name`, which stands for the file: what is no URDF, links that are not
/// there (with the nearest), and whatever the mast cannot express, by the joint's name.
UrdfMast read_urdf_mast(const std::string& text, const std::string& name,
                        const UrdfOptions& options);

}  // namespace nbvopt
