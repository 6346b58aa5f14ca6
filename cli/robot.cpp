#include "cli/robot.hpp"

#include <CLI/Option.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>

#include "cli/options/robot_file_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"

namespace nbvopt {
namespace {

struct ShowOptions {
  RobotFileArguments robot;
  std::string output_file;
};

/// "pan = 0.5 - head_pan_joint".
std::string mapping(Joint joint, const UrdfJoint& urdf) {
  std::string text = to_string(joint) + " = ";
  if (urdf.offset != 0.0) text += format_number(urdf.offset) + (urdf.scale < 0.0 ? " - " : " + ");
  if (urdf.offset == 0.0 && urdf.scale < 0.0) text += "-";
  if (std::abs(urdf.scale) != 1.0) text += format_number(std::abs(urdf.scale)) + " * ";
  return text + urdf.name;
}

/// A joint's range and velocity, and which joint of the URDF it is.
std::string joint_text(Joint joint, double min, double max, double velocity, bool is_endless,
                       const std::optional<UrdfMast>& urdf) {
  const std::string unit = joint == Joint::height ? " m" : " rad";
  if (!is_endless && min == max) return format_number(min) + unit + ", fixed";
  std::string text =
      is_endless ? "without end" : format_number(min) + " to " + format_number(max) + unit;
  text += ", at most " + format_number(velocity) + unit + "/s";
  const auto& of_urdf = urdf ? urdf->joints[static_cast<std::size_t>(joint)] : std::nullopt;
  return of_urdf ? text + ": " + mapping(joint, *of_urdf) : text;
}

std::string degrees_text(double rad) { return decimal(rad * 180.0 / std::numbers::pi, 1); }

std::string robot_text(const Robot& robot, const std::optional<UrdfMast>& urdf) {
  const MastOptions& mast = robot.mast;
  const SensorOptions& sensor = robot.sensor;
  std::string text;
  if (urdf) {
    text += "robot   " + urdf->robot_name + ", from " + urdf->base_link + " to " +
            urdf->camera_link + ", whose axes are " +
            (urdf->camera_axes == CameraAxes::optical ? "optical (z forward, x right, y down)"
                                                      : "body (x forward, y left, z up)") +
            "\n";
  }
  text += "pan     " +
          joint_text(Joint::pan, mast.pan_min_rad, mast.pan_max_rad, mast.pan_velocity_rad_s,
                     mast.pan_continuous, urdf) +
          "\n";
  text += "tilt    " +
          joint_text(Joint::tilt, mast.tilt_min_rad, mast.tilt_max_rad, mast.tilt_velocity_rad_s,
                     false, urdf) +
          "\n";
  text += "height  " +
          joint_text(Joint::height, mast.height_min_m, mast.height_max_m, mast.height_velocity_m_s,
                     false, urdf) +
          "\n";
  text += "axis    the pan axis stands at x, y = " + format_number(mast.pan_axis_x_m) + ", " +
          format_number(mast.pan_axis_y_m) + " m of the base\n";
  const Eigen::Vector3d& offset_m = mast.sensor_offset_m;
  text += "offset  " + format_number(offset_m.x()) + ", " + format_number(offset_m.y()) + ", " +
          format_number(offset_m.z()) +
          " m from the tilt axis to the optical centre: forward, left, up\n";
  text += "sensor  " + degrees_text(2.0 * sensor.half_fov_horizontal_rad) + " x " +
          degrees_text(2.0 * sensor.half_fov_vertical_rad) + " deg, " +
          format_number(sensor.range_min_m) + " to " + format_number(sensor.range_max_m) + " m, " +
          std::to_string(sensor.horizontal_rays) + " x " + std::to_string(sensor.vertical_rays) +
          " rays" + (urdf ? ": the paper's, a URDF does not tell" : "") + "\n";
  return text;
}

/// The robot file, opened by what was read of a URDF as a comment.
std::string yaml_text(const Robot& robot, const std::optional<UrdfMast>& urdf) {
  std::string comments;
  if (urdf) {
    std::istringstream lines(robot_text(robot, urdf));
    for (std::string line; std::getline(lines, line);) comments += "# " + line + "\n";
  }
  return comments + to_yaml(robot);
}

void run_show(const ShowOptions& options) {
  if (!options.output_file.empty()) require_writable(options.output_file);
  const std::string text = read_text_file(options.robot.file);
  Robot robot;
  std::optional<UrdfMast> urdf;
  if (is_xml(text)) {
    urdf = read_urdf_with_warnings(text, options.robot.file, options.robot.urdf);
    robot.mast = urdf->mast;
  } else {
    robot = parse_robot(text, options.robot.file, {}, options.robot.urdf);
  }
  if (!options.output_file.empty()) {
    write_file_atomically(options.output_file, yaml_text(robot, urdf));
  }
  print_answer(robot_text(robot, urdf));
}

void set_up_show(CLI::App& robot) {
  auto options = std::make_shared<ShowOptions>();
  CLI::App* show = robot.add_subcommand("show", "What a robot's file says");
  show->add_option("FILE", options->robot.file, "a robot: YAML or URDF")->required();
  add_urdf_options(*show, options->robot.urdf);
  show->add_option("-o,--out", options->output_file, "also write the whole robot as YAML")
      ->type_name("FILE.yaml");
  show->footer(
      "Of a URDF, it tells which joint is which, and how its values become the mast's.\n"
      "Example: nbvopt robot show robot.urdf --camera-link camera_optical_frame -o robot.yaml");
  show->callback([options] { run_show(*options); });
}

}  // namespace

void set_up_robot(CLI::App& app) {
  CLI::App* robot = app.add_subcommand("robot", "Look into robots, convert URDF to YAML");
  robot->require_subcommand(1);
  set_up_show(*robot);
}

}  // namespace nbvopt
