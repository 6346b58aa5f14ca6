// The XML of SDF files: elements and the values in them.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>

namespace nbvopt {

using SdfElement = tinyxml2::XMLElement;

/// An XML document of SDF; elements live as long as it does.
class SdfXml {
 public:
  /// Throws InputError that names the file, the line and the fault.
  SdfXml(const std::string& text, const std::string& file);

  /// <sdf>, or <gazebo> as it was called in SDF 1.2; null when the root is something else, or of
  /// SDF 1.0, which has poses and sizes in attributes.
  const SdfElement* sdf() const;

  /// Whether it is of SDF 1.0.
  bool is_too_old() const;

  /// The root, whatever it is.
  const SdfElement* root() const { return document_->RootElement(); }

 private:
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

/// Whether it is an element of that name.
bool is_named(const SdfElement& element, const char* name);

/// An attribute's value, without blanks around it; empty when there is none.
std::string attribute_of(const SdfElement& element, const char* name);

/// The text of an element, without blanks around it; empty for none.
std::string text_of(const SdfElement* element);

/// The text of a child; empty when there is none.
std::string text_of(const SdfElement& parent, const char* child);

/// Throws InputError with line, element and text, which must be what is demanded.
[[noreturn]] void refuse_value(const SdfElement& element, const std::string& demand);

/// The numbers of a child, `otherwise` when there is no such child. All of these throw InputError
/// with line, element and text when it does not hold exactly that many finite numbers.
double number_of(const SdfElement& parent, const char* child, double otherwise);
Eigen::Vector2d vector_of(const SdfElement& parent, const char* child,
                          const Eigen::Vector2d& otherwise);
Eigen::Vector3d vector_of(const SdfElement& parent, const char* child,
                          const Eigen::Vector3d& otherwise);

/// The two numbers of an element itself.
Eigen::Vector2d point_of(const SdfElement& element);

/// What a <pose> says, in the frame that it is given in: x y z and roll pitch yaw, in degrees where
/// it says so, or x y z and a quaternion x y z w. An empty one is the identity.
Eigen::Affine3d pose_of(const SdfElement& pose);

}  // namespace nbvopt
