#include "mast/urdf_chain.hpp"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "core/edit_distance.hpp"
#include "core/number.hpp"
#include "mast/urdf_text.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

[[noreturn]] void refuse_joint(const std::string& name, const std::string& joint,
                               const std::string& why) {
  throw InputError(name + ": joint '" + joint + "' " + why);
}

/// Keeps the errors that urdfdom would print, while it lives.
class HeardErrors : console_bridge::OutputHandler {
 public:
  HeardErrors() : alone_(mutex()) { console_bridge::useOutputHandler(this); }
  ~HeardErrors() override { console_bridge::restorePreviousOutputHandler(); }
  HeardErrors(const HeardErrors&) = delete;
  HeardErrors& operator=(const HeardErrors&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level != console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    errors_.push_back(text.substr(0, text.find_last_not_of('\n') + 1));
  }

  /// What was wrong, and where: the first two of them.
  std::string text() const {
    std::string text = errors_.empty() ? "it cannot be read" : errors_[0];
    if (errors_.size() > 1) text += "; " + errors_[1];
    return text;
  }

 private:
  static std::mutex& mutex() {  // the handler is one for the process
    static std::mutex mutex;
    return mutex;
  }

  std::unique_lock<std::mutex> alone_;
  std::vector<std::string> errors_;
};

urdf::ModelInterfaceSharedPtr parse(const std::string& text, const std::string& name) {
  const HeardErrors heard;
  urdf::ModelInterfaceSharedPtr model;
  std::string what;
  try {
    model = urdf::parseURDF(text);
    if (!model) what = heard.text();
  } catch (const std::exception& error) {
    what = error.what();
  }
  if (!model) throw InputError(name + ": is no URDF that can be read: " + what);
  return model;
}

/// Links by name.
class Links {
 public:
  Links(const urdf::ModelInterface& model, const std::string& name) : model_(model), name_(name) {
    for (const auto& [joint_name, joint] : model.joints_) {
      joints_to_.emplace(joint->child_link_name, joint.get());
    }
  }

  /// Throws for a link that is not there; `field` is what names it.
  void require(const std::string& link, const std::string& field) const {
    if (model_.links_.contains(link)) return;
    throw InputError(name_ + ": " + field + " is '" + link + "', which is none of its " +
                     std::to_string(model_.links_.size()) + " links, did you mean '" +
                     nearest_word(link, link_names()) + "'?");
  }

  /// The joint that holds a link; nullptr at the root.
  const urdf::Joint* joint_to(const std::string& link) const {
    const auto [begin, end] = joints_to_.equal_range(link);
    if (begin == end) return nullptr;
    if (std::next(begin) != end) {
      throw InputError(name_ + ": link '" + link + "' is the child of two joints, '" +
                       begin->second->name + "' and '" + std::next(begin)->second->name + "'");
    }
    return begin->second;
  }

  /// The link that a camera is most likely at.
  std::string likely_camera() const {
    const std::vector<std::string> names = link_names();
    for (const char* word : {"optical", "camera"}) {
      const auto found = std::ranges::find_if(
          names, [word](const std::string& link) { return link.find(word) != std::string::npos; });
      if (found != names.end()) return *found;
    }
    return names.front();
  }

 private:
  std::vector<std::string> link_names() const {
    std::vector<std::string> names;
    for (const auto& [link_name, link] : model_.links_) names.push_back(link_name);
    return names;
  }

  const urdf::ModelInterface& model_;
  const std::string& name_;
  std::multimap<std::string, const urdf::Joint*> joints_to_;
};

Transform transform(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Transform T = Transform::Identity();
  T.translation() << pose.position.x, pose.position.y, pose.position.z;
  T.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  return T;
}

/// Where a joint moves; fixed joints are not asked.
ChainJoint::Motion motion(const urdf::Joint& joint, const std::string& name) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return ChainJoint::Motion::turns;
    case urdf::Joint::PRISMATIC:
      return ChainJoint::Motion::slides;
    default:
      refuse_joint(name, joint.name,
                   std::string("is ") +
                       (joint.type == urdf::Joint::FLOATING ? "floating" : "planar") +
                       ": a mast has joints of one axis only");
  }
}

void set_limits(ChainJoint& result, const urdf::Joint& joint, const std::string& name) {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  constexpr double kFarthest = 1e4;  // rad or m
  const bool is_continuous = joint.type == urdf::Joint::CONTINUOUS;
  if (!joint.limits) {
    refuse_joint(name, joint.name,
                 "has no velocity: add <limit effort=\"...\" velocity=\"...\"/> to it");
  }
  result.min = is_continuous ? -kUnlimited : joint.limits->lower;
  result.max = is_continuous ? kUnlimited : joint.limits->upper;
  result.velocity = joint.limits->velocity;
  if (!is_continuous && std::max(std::abs(result.min), std::abs(result.max)) > kFarthest) {
    refuse_joint(name, joint.name,
                 "has the limits " + format_number(result.min) + " and " +
                     format_number(result.max) + ", they must be within " +
                     format_number(kFarthest) + " of 0 (a continuous joint has none)");
  }
  if (result.min > result.max) {
    refuse_joint(name, joint.name,
                 "has the lower limit " + format_number(result.min) + " above the upper one, " +
                     format_number(result.max));
  }
  if (!(result.velocity > 0.0) && result.min < result.max) {
    refuse_joint(name, joint.name,
                 "has the velocity limit " + format_number(result.velocity) +
                     ", it must be greater than 0 (equal limits freeze a joint)");
  }
}

/// A joint that has one place only.
void freeze(ChainJoint& joint, std::vector<std::string>& warnings) {
  warnings.push_back("joint '" + joint.name + "' has equal limits, " + format_number(joint.min) +
                     ": it is taken as fixed there");
  if (joint.motion == ChainJoint::Motion::turns) {
    joint.T_parent_child.rotate(Eigen::AngleAxisd(joint.min, joint.axis));
  } else {
    joint.T_parent_child.translate(joint.min * joint.axis);
  }
  joint.motion = ChainJoint::Motion::none;
}

ChainJoint chain_joint(const urdf::Joint& joint, const std::string& name,
                       std::vector<std::string>& warnings) {
  ChainJoint result;
  result.name = joint.name;
  result.child_link = joint.child_link_name;
  result.T_parent_child = transform(joint.parent_to_joint_origin_transform);
  if (joint.type == urdf::Joint::FIXED) return result;

  result.motion = motion(joint, name);
  result.axis << joint.axis.x, joint.axis.y, joint.axis.z;
  if (!(result.axis.norm() > 0.0)) refuse_joint(name, joint.name, "has the axis 0 0 0");
  result.axis.normalize();
  set_limits(result, joint, name);
  if (joint.mimic) {
    result.mimic = {joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
  } else if (result.min == result.max) {
    freeze(result, warnings);
  }
  return result;
}

}  // namespace

UrdfChain read_urdf_chain(const std::string& text, const std::string& name,
                          const UrdfOptions& options) {
  check_urdf_text(text, name);
  const urdf::ModelInterfaceSharedPtr model = parse(text, name);
  const Links links(*model, name);
  if (options.camera_link.empty()) {
    throw InputError(name + ": a URDF does not say which link is the camera: give camera_link, " +
                     "such as '" + links.likely_camera() + "'");
  }
  links.require(options.camera_link, "camera_link");
  UrdfChain chain;
  chain.robot_name = model->getName();
  chain.base_link = options.base_link.empty() ? model->getRoot()->name : options.base_link;
  chain.camera_link = options.camera_link;
  links.require(chain.base_link, "base_link");

  // From the camera up; a file may hold a circle beside its tree.
  std::vector<const urdf::Joint*> way;
  for (std::string link = chain.camera_link; link != chain.base_link;) {
    const urdf::Joint* joint = links.joint_to(link);
    if (joint == nullptr || way.size() > model->joints_.size()) {
      throw InputError(name + ": link '" + chain.camera_link + "' does not hang on '" +
                       chain.base_link + "', base_link must be one of the links that carry it");
    }
    way.push_back(joint);
    link = joint->parent_link_name;
  }
  std::reverse(way.begin(), way.end());
  for (const urdf::Joint* joint : way) {
    chain.joints.push_back(chain_joint(*joint, name, chain.warnings));
  }
  return chain;
}

}  // namespace nbvopt
