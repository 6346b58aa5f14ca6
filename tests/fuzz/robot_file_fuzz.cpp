// Whatever text stands for a robot, YAML or URDF, parse_robot() gives a valid robot or an
// InputError; a robot that was read is written and read again unchanged.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/robot.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    nbvopt::UrdfOptions urdf;
    if (nbvopt::is_xml(text)) urdf.camera_link = "camera_link";
    const nbvopt::Robot robot = nbvopt::parse_robot(text, "fuzz", {}, urdf);
    if (nbvopt::parse_robot(nbvopt::to_yaml(robot), "fuzz") != robot) std::abort();
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
