// The pose files of recordings.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

/// A line "key x y z qx qy qz qw", the key being a time or a frame's name; or "key x y z".
struct KeyedPose {
  std::string key;
  Transform T_world_frame = Transform::Identity();
  bool has_orientation = true;
};

/// Lines of words with spaces or commas between; '#' starts a comment. Throws InputError that names
/// file and line.
std::vector<KeyedPose> parse_keyed_poses(const std::string& text, const std::string& name);

/// A 4 x 4 or 3 x 4 matrix, row by row; none where a number is not finite, which stands for a frame
/// that was not tracked. Throws InputError for anything else, and for what is no rigid transform.
std::optional<Transform> parse_pose_matrix(const std::string& text, const std::string& name);

/// One such matrix a line: none for lines of frames that were not tracked.
std::vector<std::optional<Transform>> parse_matrix_lines(const std::string& text,
                                                         const std::string& name);

/// A frame of an Open3D trajectory: three numbers, the first one the frame, and a 4 x 4 matrix.
struct NumberedPose {
  std::uint64_t frame = 0;
  std::optional<Transform> T_world_frame;
};
std::vector<NumberedPose> parse_trajectory_log(const std::string& text, const std::string& name);

/// The line "<key>: ..." of a KITTI calibration, a 3 x 4 matrix. Throws InputError without one.
Transform parse_calibration(const std::string& text, const std::string& key,
                            const std::string& name);

/// fx, fy, cx, cy of a camera's 3 x 3 or 4 x 4 matrix.
std::array<double, 4> parse_camera_matrix(const std::string& text, const std::string& name);

/// Poses by time, for the nearest to be found.
class TimedPoses {
 public:
  /// Throws InputError for a key that is no time.
  TimedPoses(const std::vector<KeyedPose>& poses, const std::string& name);

  /// The pose nearest in time, the earlier of two; none where it is farther than that.
  const KeyedPose* nearest(double time_s, double max_difference_s) const;

 private:
  struct Entry {
    double time_s;
    const KeyedPose* pose;
  };
  std::vector<Entry> by_time_;
};

}  // namespace nbvopt
