#include "nbvopt/mast/mast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/enum_names.hpp"
#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

template <>
inline constexpr auto kEnumNames<Joint> = std::to_array<EnumName<Joint>>({
    {Joint::pan, "pan"},
    {Joint::tilt, "tilt"},
    {Joint::height, "height"},
});

namespace {

/// The limits of all joints; a continuous pan has none.
JointBox limits(const MastOptions& options) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  JointBox box;
  box.min << (options.pan_continuous ? -kNoLimit : options.pan_min_rad), options.tilt_min_rad,
      options.height_min_m;
  box.max << (options.pan_continuous ? kNoLimit : options.pan_max_rad), options.tilt_max_rad,
      options.height_max_m;
  return box;
}

const char* unit(Joint joint) { return joint == Joint::height ? " m" : " rad"; }

/// How far beyond its limits a joint may stand and still be moved into them: what an encoder's
/// noise or a rounded number explains.
double clamp_tolerance(Joint joint) { return joint == Joint::height ? 0.005 : 0.01; }

}  // namespace

std::string to_string(Joint value) { return std::string(enum_name(value)); }

Mast::Mast(const MastOptions& options) : options_(options) {
  options_.validate();
  velocity_ << options_.pan_velocity_rad_s, options_.tilt_velocity_rad_s,
      options_.height_velocity_m_s;
}

Transform Mast::T_base_sensor(const JointPosition& q) const {
  return T_base_mast() * T_mast_sensor(q);
}

Transform Mast::T_base_mast() const {
  return Transform(Eigen::Translation3d(options_.pan_axis_x_m, options_.pan_axis_y_m, 0.0));
}

Transform Mast::T_mast_sensor(const JointPosition& q) const {
  Transform T_mast_body = Transform::Identity();
  T_mast_body.translate(Eigen::Vector3d(0.0, 0.0, q.height_m));
  T_mast_body.rotate(Eigen::AngleAxisd(q.pan_rad, Eigen::Vector3d::UnitZ()));
  // A turn about body y (left) by a positive angle looks down; positive tilt looks up.
  T_mast_body.rotate(Eigen::AngleAxisd(-q.tilt_rad, Eigen::Vector3d::UnitY()));
  Transform T_body_sensor = Transform::Identity();
  T_body_sensor.translation() = options_.sensor_offset_m;
  T_body_sensor.linear() = rotation_body_sensor();
  return T_mast_body * T_body_sensor;
}

JointBox Mast::reachable_box(const JointPosition& q, double motion_time_s) const {
  if (!std::isfinite(motion_time_s) || motion_time_s < 0.0) {
    throw UsageError("motion time is " + format_number(motion_time_s) +
                     " s, it must be 0 (no limit) or more");
  }
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  Eigen::Vector3d reach = Eigen::Vector3d::Constant(kUnlimited);
  if (motion_time_s > 0.0) reach = velocity_ * motion_time_s;
  if (options_.pan_continuous) reach[0] = std::min(reach[0], std::numbers::pi);

  // Algorithm 2: [max(min, q - v t), min(max, q + v t)].
  const JointBox joint_limits = limits(options_);
  JointBox box;
  box.min = joint_limits.min.cwiseMax(q.vector() - reach);
  box.max = joint_limits.max.cwiseMin(q.vector() + reach);
  if (!box.contains(q.vector())) {
    throw UsageError("the joints are beyond their limits, move them in with Mast::clamped first");
  }
  return box;
}

double Mast::move_time_s(const JointPosition& from, const JointPosition& to) const {
  return ((to.vector() - from.vector()).cwiseAbs().array() / velocity_.array()).maxCoeff();
}

JointPosition Mast::on_the_way(const JointPosition& from, const JointPosition& to,
                               double elapsed_s) const {
  const Eigen::Vector3d reach = velocity_ * elapsed_s;
  const Eigen::Vector3d way = to.vector() - from.vector();
  // Not from + way, so that who has arrived is there to the last bit.
  return JointPosition::from(
      (way.cwiseAbs().array() <= reach.array())
          .select(to.vector(), from.vector() + way.cwiseSign().cwiseProduct(reach)));
}

JointPosition Mast::clamped(const JointPosition& q, std::vector<std::string>& warnings) const {
  constexpr double kFarthestTurned_rad = 1e4;  // beyond, doubles lose what a search resolves
  if (options_.pan_continuous && std::abs(q.pan_rad) > kFarthestTurned_rad &&
      std::isfinite(q.pan_rad)) {
    throw InputError("pan is " + format_number(q.pan_rad) + " rad, it must be within " +
                     format_number(kFarthestTurned_rad) + " rad of 0: take whole turns off it");
  }
  const JointBox joint_limits = limits(options_);
  Eigen::Vector3d inside = q.vector();
  for (const Joint joint : kJoints) {
    const auto i = static_cast<Eigen::Index>(joint);
    const double value = inside[i];
    const double min = joint_limits.min[i];
    const double max = joint_limits.max[i];
    if (value >= min && value <= max && std::isfinite(value)) continue;

    const std::string found = to_string(joint) + " is " + format_number(value) + unit(joint);
    if (!std::isfinite(value)) throw InputError(found + ", it must be a finite number");
    const std::string range =
        "its limits, " + format_number(min) + " to " + format_number(max) + unit(joint);
    const double tolerance = clamp_tolerance(joint);
    if (value < min - tolerance || value > max + tolerance) {
      throw InputError(found + ", it must be within " + range);
    }
    inside[i] = std::clamp(value, min, max);
    warnings.push_back(found + ", moved into " + range);
  }
  return JointPosition::from(inside);
}

}  // namespace nbvopt
