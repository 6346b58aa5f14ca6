// Whatever text stands for a trajectory, parse_trajectory() gives one that says at any time where
// the base is, or an InputError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/trajectory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const nbvopt::Trajectory drive = nbvopt::parse_trajectory(text, "fuzz");
    const auto& first = drive.points().front();
    if (drive.T_map_base(-1.0).translation() != Eigen::Vector3d(first.x_m, first.y_m, first.z_m)) {
      std::abort();
    }
    drive.T_map_base(0.5 * drive.duration_s());
  } catch (const nbvopt::InputError&) {
  }
  return 0;
}
