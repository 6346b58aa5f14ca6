#include "ros1/node/parameters.hpp"

#include <cmath>

#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

/// Reads parameters of one node, each by its name and type.
class Parameters {
 public:
  explicit Parameters(const ros::NodeHandle& node) : node_(node) {}

  bool has(const std::string& name) const { return node_.hasParam(name); }

  /// Leaves the value alone where there is no such parameter.
  template <class Value>
  bool read(const std::string& name, Value& value) const {
    if (!has(name)) return false;
    if (!node_.getParam(name, value)) {
      throw InputError("parameter " + full_name(name) + " is not of the type that it must be");
    }
    return true;
  }
  bool read_number(const std::string& name, double& value) const {
    if (!read(name, value)) return false;
    if (!std::isfinite(value)) throw InputError(full_name(name) + " must be finite");
    return true;
  }
  void read_not_negative(const std::string& name, double& value) const {
    if (read_number(name, value) && value < 0.0) {
      throw InputError("parameter " + full_name(name) + " is " + format_number(value) +
                       ", it must not be negative");
    }
  }
  void read_positive(const std::string& name, double& value) const {
    if (read_number(name, value) && value <= 0.0) {
      throw InputError("parameter " + full_name(name) + " is " + format_number(value) +
                       ", it must be greater than 0");
    }
  }
  /// A count of rays, which the paper's nodes keep as a floating-point number.
  void read_count(const std::string& name, int& count) const {
    double value = count;
    if (!read_number(name, value)) return;
    if (value < 1.0 || value > 10'000.0 || value != std::floor(value)) {
      throw InputError("parameter " + full_name(name) + " is " + format_number(value) +
                       ", it must be a whole number from 1 to 10000");
    }
    count = static_cast<int>(value);
  }
  /// tf knows no leading slash.
  void read_frame(const std::string& name, std::string& frame) const {
    read(name, frame);
    if (frame.starts_with('/')) frame.erase(0, 1);
  }
  std::string full_name(const std::string& name) const { return node_.resolveName(name); }

 private:
  const ros::NodeHandle& node_;
};

/// Half of a field of view that must lie evenly about the optical axis.
void read_half_angle(const Parameters& parameters, const std::string& name, double& half_rad) {
  double min_rad = -half_rad;
  double max_rad = half_rad;
  const bool is_given = parameters.read_number(name + "/min", min_rad) |
                        parameters.read_number(name + "/max", max_rad);
  if (!is_given) return;
  constexpr double kTolerance_rad = 1e-3;
  if (std::abs(min_rad + max_rad) > kTolerance_rad || max_rad <= 0.0) {
    throw InputError("parameters " + parameters.full_name(name) + "/min and max are " +
                     format_number(min_rad) + " and " + format_number(max_rad) +
                     " rad, they must lie evenly about 0");
  }
  half_rad = max_rad;
}

void read_sensor(const Parameters& parameters, SensorOptions& sensor) {
  parameters.read_count("fov/resolution/horizontal", sensor.horizontal_rays);
  parameters.read_count("fov/resolution/vertical", sensor.vertical_rays);
  read_half_angle(parameters, "fov/angle/horizontal", sensor.half_fov_horizontal_rad);
  read_half_angle(parameters, "fov/angle/vertical", sensor.half_fov_vertical_rad);
  parameters.read_number("sensor_model/max_range", sensor.range_max_m);
  parameters.read_number("fov/range/min", sensor.range_min_m);
  parameters.read_number("fov/range/max", sensor.range_max_m);
}

/// The mast's fields of one joint.
struct JointFields {
  double *min, *max, *velocity;
  double rest;  ///< where it stays if nothing says where
};

/// What the parameters of a joint change: its limits, its velocity, its name, or that it stays.
void read_joint(const Parameters& parameters, Joint which, const JointFields& fields,
                std::optional<RosJoint>& joint) {
  const std::string prefix = to_string(which) + "/";
  parameters.read_positive(prefix + "vel", *fields.velocity);
  parameters.read_number(prefix + "min", *fields.min);
  parameters.read_number(prefix + "max", *fields.max);
  std::string name = joint ? joint->name : "";
  parameters.read(prefix + "joint_name", name);
  bool is_moved = !name.empty();
  parameters.read(prefix + "optimize", is_moved);
  if (is_moved && name.empty()) {
    throw InputError("parameter " + parameters.full_name(prefix + "joint_name") +
                     " is missing, which joint is it?");
  }
  if (is_moved) {
    joint = joint.value_or(RosJoint{});
    joint->name = name;
    return;
  }
  joint.reset();
  double rest = *fields.min == *fields.max ? *fields.min : fields.rest;
  parameters.read_number(prefix + "position", rest);
  *fields.min = *fields.max = rest;
}

void read_mast(const Parameters& parameters, NodeParameters& node) {
  MastOptions& mast = node.robot.mast;
  // The paper's nodes say by 0 and 0 that a joint turns without end.
  double pan_min_rad = mast.pan_continuous ? 0.0 : mast.pan_min_rad;
  double pan_max_rad = mast.pan_continuous ? 0.0 : mast.pan_max_rad;
  read_joint(parameters, Joint::pan, {&pan_min_rad, &pan_max_rad, &mast.pan_velocity_rad_s, 0.0},
             node.joints[0]);
  mast.pan_continuous = node.joints[0] && pan_min_rad == 0.0 && pan_max_rad == 0.0;
  if (!mast.pan_continuous) {
    mast.pan_min_rad = pan_min_rad;
    mast.pan_max_rad = pan_max_rad;
  }
  read_joint(parameters, Joint::tilt,
             {&mast.tilt_min_rad, &mast.tilt_max_rad, &mast.tilt_velocity_rad_s, 0.0},
             node.joints[1]);
  const double half_way_m = 0.5 * (mast.height_min_m + mast.height_max_m);
  read_joint(parameters, Joint::height,
             {&mast.height_min_m, &mast.height_max_m, &mast.height_velocity_m_s, half_way_m},
             node.joints[2]);
}

/// The robot's file, or the URDF that others have put on the parameter server.
void read_robot_description(const ros::NodeHandle& ros_node, const Parameters& parameters,
                            NodeParameters& node) {
  UrdfOptions urdf;
  parameters.read("camera_link", urdf.camera_link);
  std::string file;
  std::string text;
  if (parameters.read("robot", file) && !file.empty()) {
    text = read_text_file(file);
  } else if (!urdf.camera_link.empty()) {
    file = "robot_description";
    std::string key;
    if (!ros_node.searchParam(file, key) || !ros_node.getParam(key, text)) {
      throw InputError("parameter robot_description is missing, in which camera_link, '" +
                       urdf.camera_link + "', would be looked for");
    }
  } else {
    return;
  }
  if (!is_xml(text)) {
    node.robot = parse_robot(text, file);
    return;
  }
  urdf.base_link = node.base_frame;
  const UrdfMast mast = read_urdf_mast(text, file, urdf);
  for (const std::string& warning : mast.warnings)
    ROS_WARN("%s: %s", file.c_str(), warning.c_str());
  node.robot.mast = mast.mast;
  node.joints = mast.joints;
}

void read_image_transport(const Parameters& parameters, std::string& transport) {
  parameters.read("image_transport", transport);
  if (transport == "raw" || transport == "compressedDepth" || transport == "compressed") return;
  throw InputError("parameter " + parameters.full_name("image_transport") + " is '" + transport +
                   "', it must be raw, compressedDepth or compressed");
}

/// What OctoMap's server lets choose and this one does not.
void warn_of_sensor_model(const Parameters& parameters) {
  constexpr std::array<std::pair<const char*, double>, 4> kFixed{
      {{"hit", 0.7}, {"miss", 0.4}, {"min", 0.12}, {"max", 0.97}}};
  for (const auto& [name, fixed] : kFixed) {
    double value = fixed;
    parameters.read_number("sensor_model/" + std::string(name), value);
    if (value != fixed) {
      ROS_WARN("sensor_model/%s is %g, maps are made with %g", name, value, fixed);
    }
  }
}

}  // namespace

NodeParameters read_parameters(const ros::NodeHandle& ros_node) {
  const Parameters parameters(ros_node);
  NodeParameters node;
  parameters.read_frame("frame_id", node.map_frame);
  parameters.read_frame("global_frame", node.map_frame);
  parameters.read_frame("base_frame_id", node.base_frame);
  parameters.read_frame("base_frame", node.base_frame);
  parameters.read_frame("sensor_frame", node.sensor_frame);
  read_image_transport(parameters, node.image_transport);
  node.joints[0] = RosJoint{.name = "telescopic_arm_continuous_joint"};
  read_robot_description(ros_node, parameters, node);
  read_sensor(parameters, node.robot.sensor);
  read_mast(parameters, node);
  node.robot.sensor.validate();
  node.robot.mast.validate();
  parameters.read("map", node.map_file);
  parameters.read_positive("resolution", node.resolution_m);
  parameters.read_positive("time_limit_ms", node.time_limit_ms);
  parameters.read_not_negative("arrival/timeout", node.arrival_timeout_s);
  parameters.read_positive("arrival/angle", node.arrival_angle_rad);
  parameters.read_positive("arrival/height", node.arrival_height_m);
  parameters.read_not_negative("path_speed", node.path_speed_m_s);
  parameters.read_positive("publish_period", node.publish_period_s);
  parameters.read("publish_free_space", node.publishes_free_space);
  parameters.read_number("occupancy_min_z", node.shown_band.min_m);
  parameters.read_number("occupancy_max_z", node.shown_band.max_m);
  warn_of_sensor_model(parameters);
  return node;
}

}  // namespace nbvopt
