#include "nbvopt/mast/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/number.hpp"
#include "mast/urdf_chain.hpp"
#include "mast/urdf_names.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr double kAngleTolerance_rad = 2e-3;  // files give 1.57 for a right angle
constexpr double kOffsetTolerance_m = 1e-3;   // what such an angle does half a metre on
constexpr double kWorthTelling = 1e-5;

/// A sum of decimals as the decimal that it stands for.
double rounded(double value) { return std::round(value * 1e12) / 1e12 + 0.0; }

/// By nothing, a limit keeps its bits.
double moved(double limit, double offset) {
  return offset == 0.0 ? limit : rounded(limit + offset);
}

double scaled(double limit, double scale) {
  return std::abs(scale) == 1.0 ? scale * limit + 0.0 : rounded(scale * limit);
}

std::string quoted(const std::string& joint) { return "'" + joint + "'"; }

/// The joint of a chain with its axis in the frame of the base, all joints at 0.
struct BaseAxis {
  const ChainJoint* joint = nullptr;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();

  /// 1 for an axis along `reference`, -1 for one against it.
  double sense(const Eigen::Vector3d& reference) const {
    return direction.dot(reference) > 0.0 ? 1.0 : -1.0;
  }
};

/// Takes a chain apart, joint by joint from the base on.
class MastReader {
 public:
  MastReader(const UrdfChain& chain, std::string name, CameraAxes axes)
      : chain_(chain), name_(std::move(name)), axes_(axes) {
    result_.robot_name = chain.robot_name;
    result_.base_link = chain.base_link;
    result_.camera_link = chain.camera_link;
    result_.camera_axes = axes;
    result_.warnings = chain.warnings;
  }

  UrdfMast read() {
    sort_joints();
    look_at_camera();
    set_pan();
    set_tilt();
    set_height();
    set_offsets();
    if (!pan_ && !tilt_ && stages_.empty()) {
      warn("no joint between '" + chain_.base_link + "' and '" + chain_.camera_link +
           "' moves, so that there is one view only");
    }
    if (neglected_ > kWorthTelling) {
      warn("the joints' axes are up to " + decimal(neglected_, 6) +
           " rad or m off those of a mast, which is neglected");
    }
    try {
      result_.mast.validate();
    } catch (const InputError& error) {
      throw InputError(name_ + ": " + error.what());
    }
    return result_;
  }

 private:
  [[noreturn]] void refuse(const ChainJoint& joint, const std::string& why) const {
    throw InputError(name_ + ": joint " + quoted(joint.name) + " " + why);
  }

  void warn(const std::string& text) { result_.warnings.push_back(text); }

  /// Whether a number that should be 0 is, to the tolerance.
  bool is_zero(double off, double tolerance) {
    if (!(std::abs(off) <= tolerance)) return false;
    neglected_ = std::max(neglected_, std::abs(off));
    return true;
  }

  /// Tells pan, tilt and the stages of the lift by type and axis.
  void sort_joints() {
    for (const ChainJoint& joint : chain_.joints) {
      T_base_camera_ = T_base_camera_ * joint.T_parent_child;
      if (joint.motion == ChainJoint::Motion::none) continue;
      const BaseAxis axis{&joint, T_base_camera_.linear() * joint.axis,
                          T_base_camera_.translation()};
      if (joint.motion == ChainJoint::Motion::slides) {
        take_stage(axis);
      } else {
        take_turn(axis);
      }
    }
  }

  void take_stage(const BaseAxis& axis) {
    if (!is_zero(axis.direction.head<2>().norm(), kAngleTolerance_rad)) {
      refuse(*axis.joint, "slides along " + text(axis.direction) + " of " +
                              quoted(chain_.base_link) + ": a mast lifts along z only");
    }
    if (tilt_) {
      refuse(*axis.joint, "lifts what joint " + quoted(tilt_->joint->name) +
                              " tilts: in a mast the tilt comes last");
    }
    stages_.push_back(axis);
  }

  void take_turn(const BaseAxis& axis) {
    const bool is_vertical = is_zero(axis.direction.head<2>().norm(), kAngleTolerance_rad);
    if (!is_vertical && !is_zero(axis.direction.z(), kAngleTolerance_rad)) {
      refuse(*axis.joint, "turns about " + text(axis.direction) + " of " +
                              quoted(chain_.base_link) +
                              ": a mast pans about z and tilts about a horizontal axis");
    }
    if (axis.joint->mimic) {
      refuse(*axis.joint, "mimics joint " + quoted(axis.joint->mimic->joint) +
                              ", which only the stages of a lift can");
    }
    std::optional<BaseAxis>& place = is_vertical ? pan_ : tilt_;
    if (place) {
      refuse(*axis.joint, std::string("is the second that turns about a ") +
                              (is_vertical ? "vertical" : "horizontal") + " axis, after joint " +
                              quoted(place->joint->name) + ": a mast has one " +
                              (is_vertical ? "pan" : "tilt"));
    }
    if (tilt_) {
      refuse(*axis.joint, "pans what joint " + quoted(tilt_->joint->name) +
                              " tilts: in a mast the tilt comes last");
    }
    place = axis;
  }

  /// The pan and tilt of the camera where all joints are at 0.
  void look_at_camera() {
    R_base_body_ = T_base_camera_.linear();
    if (axes_ == CameraAxes::optical) R_base_body_ *= rotation_body_sensor().transpose();
    const Eigen::Vector3d forward = R_base_body_.col(0);
    const Eigen::Vector3d left = R_base_body_.col(1);
    if (tilt_ && !is_zero(tilt_->direction.cross(left).norm(), kAngleTolerance_rad)) {
      refuse(*tilt_->joint, "turns about an axis that is not the camera's left or right, with " +
                                axes_text() + ": a mast cannot roll its camera");
    }
    if (!is_zero(left.z(), kAngleTolerance_rad)) {
      throw InputError(name_ + ": link " + quoted(chain_.camera_link) + " is rolled by " +
                       decimal(std::asin(std::clamp(left.z(), -1.0, 1.0)), 3) + " rad, with " +
                       axes_text() + ": a mast holds its camera level");
    }
    // R_base_body = Rz(pan) Ry(-tilt): left is (-sin pan, cos pan, 0), forward
    // (cos pan cos tilt, sin pan cos tilt, sin tilt).
    pan_0_rad_ = rounded(std::atan2(-left.x(), left.y()));
    heading_ << left.y(), -left.x(), 0.0;
    tilt_0_rad_ = rounded(std::atan2(forward.z(), forward.dot(heading_)));
  }

  std::string axes_text() const {
    return axes_ == CameraAxes::optical ? "optical axes (camera_axes may be body)"
                                        : "body axes (camera_axes may be optical)";
  }

  void set_pan() {
    MastOptions& mast = result_.mast;
    if (!pan_) {
      mast.pan_continuous = false;
      mast.pan_min_rad = mast.pan_max_rad = pan_0_rad_;
      return;
    }
    const ChainJoint& joint = *pan_->joint;
    const double scale = pan_->sense(Eigen::Vector3d::UnitZ());
    result_.joints[0] = UrdfJoint{joint.name, scale, pan_0_rad_};
    mast.pan_velocity_rad_s = joint.velocity;
    mast.pan_continuous = std::isinf(joint.max);
    if (mast.pan_continuous) return;
    std::tie(mast.pan_min_rad, mast.pan_max_rad) = range(joint, scale, pan_0_rad_);
  }

  void set_tilt() {
    MastOptions& mast = result_.mast;
    constexpr double kUpright_rad = 0.5 * std::numbers::pi;
    if (!tilt_) {
      if (std::abs(tilt_0_rad_) > kUpright_rad) refuse_upside_down();
      mast.tilt_min_rad = mast.tilt_max_rad = tilt_0_rad_;
      return;
    }
    const ChainJoint& joint = *tilt_->joint;
    const double scale = -tilt_->sense(R_base_body_.col(1));  // about left, it looks down
    auto [min, max] = range(joint, scale, tilt_0_rad_);
    if (std::isfinite(min)) {
      const double middle = 0.5 * (min + max);
      const double turns = std::round(middle / (2.0 * std::numbers::pi)) * 2.0 * std::numbers::pi;
      min = moved(min, -turns);
      max = moved(max, -turns);
      tilt_0_rad_ = moved(tilt_0_rad_, -turns);
      if (std::abs(middle - turns) > kUpright_rad) refuse_upside_down();
    }
    if (std::max(-min, max) > kUpright_rad + kAngleTolerance_rad) {
      warn("joint " + quoted(joint.name) + " tilts further than straight up or down, where the " +
           "mast ends");
    }
    result_.joints[1] = UrdfJoint{joint.name, scale, tilt_0_rad_};
    mast.tilt_min_rad = std::max(min, -kUpright_rad);
    mast.tilt_max_rad = std::min(max, kUpright_rad);
    mast.tilt_velocity_rad_s = joint.velocity;
  }

  [[noreturn]] void refuse_upside_down() const {
    throw InputError(name_ + ": link " + quoted(chain_.camera_link) + " is upside down, with " +
                     axes_text() + ": a mast holds its camera upright");
  }

  /// The stages that mimic one are lifted with it: value = multiplier * its value + offset.
  void set_height() {
    MastOptions& mast = result_.mast;
    const double z_m = rounded(tilt_ ? tilt_->point_m.z() : T_base_camera_.translation().z());
    if (stages_.empty()) {
      mast.height_min_m = mast.height_max_m = z_m;
      return;
    }
    ChainJoint lift = *leader().joint;
    UrdfJoint all{lift.name, 0.0, z_m};
    for (const BaseAxis& stage : stages_) {
      const ChainJoint& joint = *stage.joint;
      const double sense = stage.sense(Eigen::Vector3d::UnitZ());
      if (!joint.mimic) {
        all.scale += sense;
        continue;
      }
      const auto [leader, multiplier, offset_m] = *joint.mimic;
      if (leader != lift.name || multiplier == 0.0) {
        refuse(joint, "mimics joint " + quoted(leader) + " with multiplier " +
                          format_number(multiplier) + ", it must mimic the lift's first stage, " +
                          quoted(lift.name));
      }
      all.scale += sense * multiplier;
      all.offset += sense * offset_m;
      const auto [min, max] = std::minmax({rounded((joint.min - offset_m) / multiplier),
                                           rounded((joint.max - offset_m) / multiplier)});
      lift.min = std::max(lift.min, min);
      lift.max = std::min(lift.max, max);
      lift.velocity = std::min(lift.velocity, joint.velocity / std::abs(multiplier));
    }
    all.scale = rounded(all.scale);
    all.offset = rounded(all.offset);
    if (all.scale == 0.0 || lift.min > lift.max) {
      refuse(lift,
             "lifts nothing: the stages that mimic it take back what it lifts, or have "
             "limits that it cannot meet");
    }
    result_.joints[2] = all;
    std::tie(mast.height_min_m, mast.height_max_m) = range(lift, all.scale, all.offset);
    mast.height_velocity_m_s = scaled(lift.velocity, std::abs(all.scale));
  }

  /// The stage that mimics none.
  const BaseAxis& leader() const {
    const auto is_free = [](const BaseAxis& stage) { return !stage.joint->mimic; };
    const auto first = std::ranges::find_if(stages_, is_free);
    if (first == stages_.end()) {
      refuse(*stages_[0].joint, "mimics joint " + quoted(stages_[0].joint->mimic->joint) +
                                    ", which is no lift between " + quoted(chain_.base_link) +
                                    " and " + quoted(chain_.camera_link));
    }
    const auto second = std::find_if(std::next(first), stages_.end(), is_free);
    if (second != stages_.end()) {
      refuse(*second->joint, "is the second that lifts, after joint " + quoted(first->joint->name) +
                                 ": a mast has one lift (its stages may mimic one)");
    }
    return *first;
  }

  /// Where the pan axis stands, and from where the tilt axis meets it, or from the camera's own
  /// height without one, to the optical centre.
  void set_offsets() {
    const Eigen::Vector3d camera_m = T_base_camera_.translation();
    Eigen::Vector3d axis_m = Eigen::Vector3d::Zero();
    if (pan_) {
      axis_m << pan_->point_m.head<2>(), 0.0;
    } else if (tilt_) {
      axis_m = tilt_->point_m.dot(heading_) * heading_;  // any point of the tilt axis would do
    }
    if (tilt_) require_on_axis(axis_m);
    result_.mast.pan_axis_x_m = rounded(axis_m.x());
    result_.mast.pan_axis_y_m = rounded(axis_m.y());
    axis_m.z() = tilt_ ? tilt_->point_m.z() : camera_m.z();
    result_.mast.sensor_offset_m =
        (R_base_body_.transpose() * (camera_m - axis_m)).unaryExpr([](double value) {
          return rounded(value);
        });
  }

  /// The tilt axis meets the pan axis.
  void require_on_axis(const Eigen::Vector3d& axis_m) {
    const double before_m = (tilt_->point_m - axis_m).dot(heading_);
    if (is_zero(before_m, kOffsetTolerance_m)) return;
    refuse(*tilt_->joint, "tilts about a line " + decimal(before_m, 4) +
                              " m before the axis of joint " + quoted(pan_->joint->name) +
                              ": in a mast they meet");
  }

  static std::pair<double, double> range(const ChainJoint& joint, double scale, double offset) {
    const auto [min, max] = std::minmax({scaled(joint.min, scale), scaled(joint.max, scale)});
    return {moved(min, offset), moved(max, offset)};
  }

  static std::string text(const Eigen::Vector3d& v) {
    return "(" + decimal(v.x(), 3) + ", " + decimal(v.y(), 3) + ", " + decimal(v.z(), 3) + ")";
  }

  const UrdfChain& chain_;
  std::string name_;
  CameraAxes axes_;
  UrdfMast result_;
  std::optional<BaseAxis> pan_;
  std::optional<BaseAxis> tilt_;
  std::vector<BaseAxis> stages_;
  Transform T_base_camera_ = Transform::Identity();  ///< so far, or in the end; joints at 0
  Eigen::Matrix3d R_base_body_ = Eigen::Matrix3d::Identity();  ///< of the camera, joints at 0
  Eigen::Vector3d heading_ = Eigen::Vector3d::UnitX();         ///< its forward, level
  double pan_0_rad_ = 0.0;
  double tilt_0_rad_ = 0.0;
  double neglected_ = 0.0;  ///< the most that anything was off, rad or m
};

}  // namespace

std::string to_string(CameraAxes value) { return std::string(enum_name(value)); }

UrdfMast read_urdf_mast(const std::string& text, const std::string& name,
                        const UrdfOptions& options) {
  const UrdfChain chain = read_urdf_chain(text, name, options);
  const bool is_named_optical = options.camera_link.find("optical") != std::string::npos;
  const CameraAxes axes =
      options.camera_axes.value_or(is_named_optical ? CameraAxes::optical : CameraAxes::body);
  return MastReader(chain, name, axes).read();
}

}  // namespace nbvopt
