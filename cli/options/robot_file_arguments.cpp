#include "cli/options/robot_file_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "cli/terminal/output.hpp"
#include "core/text_file.hpp"
#include "mast/urdf_names.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

void add_robot_file(CLI::App& app, RobotFileArguments& arguments) {
  app.add_option("--robot", arguments.file,
                 "the robot: a YAML file (sensor and mast) or a URDF (mast) [the paper's platform]")
      ->type_name("FILE");
  add_urdf_options(app, arguments.urdf);
}

void add_urdf_options(CLI::App& app, UrdfOptions& options) {
  app.add_option("--camera-link", options.camera_link, "of a URDF: the optical centre's link")
      ->type_name("LINK");
  app.add_option("--base-link", options.base_link, "of a URDF: the base's link [its root]")
      ->type_name("LINK");
  app.add_option_function<std::string>(
         "--camera-axes",
         [&options](const std::string& axes) {
           options.camera_axes = enum_value<CameraAxes>(axes);
         },
         "of the camera's link: optical (z forward, x right, y down) or body (x forward, y left, z "
         "up) [optical if its name says so, else body]")
      ->check(CLI::IsMember(enum_names<CameraAxes>()))
      ->type_name("NAME");
}

Robot read_robot(const RobotFileArguments& arguments, Robot defaults) {
  if (arguments.file.empty()) {
    if (arguments.urdf != UrdfOptions{}) {
      throw UsageError(
          "--camera-link, --base-link and --camera-axes are of a URDF: name it by "
          "--robot");
    }
    return defaults;
  }
  const std::string text = read_text_file(arguments.file);
  if (!is_xml(text)) return parse_robot(text, arguments.file, defaults, arguments.urdf);
  defaults.mast = read_urdf_with_warnings(text, arguments.file, arguments.urdf).mast;
  return defaults;
}

UrdfMast read_urdf_with_warnings(const std::string& text, const std::string& file,
                                 const UrdfOptions& options) {
  UrdfMast urdf = read_urdf_mast(text, file, options);
  for (const std::string& warning : urdf.warnings)
    print_message("warning: " + file + ": " + warning);
  return urdf;
}

}  // namespace nbvopt
