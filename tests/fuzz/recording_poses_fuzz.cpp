// Whatever text stands for the poses of a recording, its parsers give rigid transforms or an
// InputError.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "map/recording/pose_lists.hpp"
#include "nbvopt/core/error.hpp"

namespace {

void expect_rigid(const nbvopt::Transform& T) {
  const Eigen::Matrix3d R = T.linear();
  const bool is_rotation = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-6;
  if (!T.matrix().allFinite() || !is_rotation) std::abort();
}

/// Calls `parse`, which may refuse.
template <class Parse>
void attempt(const Parse& parse) {
  try {
    parse();
  } catch (const nbvopt::InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  attempt([&] {
    const auto poses = nbvopt::parse_keyed_poses(text, "fuzz");
    for (const auto& pose : poses) expect_rigid(pose.T_world_frame);
    nbvopt::TimedPoses(poses, "fuzz").nearest(1.0, 0.02);
  });
  attempt([&] {
    if (const auto T = nbvopt::parse_pose_matrix(text, "fuzz")) expect_rigid(*T);
  });
  attempt([&] {
    for (const auto& T : nbvopt::parse_matrix_lines(text, "fuzz")) {
      if (T) expect_rigid(*T);
    }
  });
  attempt([&] {
    for (const auto& pose : nbvopt::parse_trajectory_log(text, "fuzz")) {
      if (pose.T_world_frame) expect_rigid(*pose.T_world_frame);
    }
  });
  attempt([&] { expect_rigid(nbvopt::parse_calibration(text, "Tr", "fuzz")); });
  attempt([&] { nbvopt::parse_camera_matrix(text, "fuzz"); });
  return 0;
}
