// The conventions of public recordings: a table.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "nbvopt/map/recording.hpp"

namespace nbvopt {

/// Where the frames of a recording get their poses from.
enum class PoseSource {
  by_time,         ///< a file of times; a frame's time is in a list of frames or in its name
  by_name,         ///< a file of names or times
  file_a_frame,    ///< a matrix in a file beside each frame, or in another folder
  matrix_a_line,   ///< line n belongs to frame n
  trajectory_log,  ///< numbered matrices
  kitti,           ///< a matrix a line, of the camera; the laser's place is in calib.txt
  viewpoint,       ///< in the frame itself
};

struct Convention {
  RecordingFormat format;
  PoseSource source;
  std::string_view frame_folder;  ///< in the recording's; empty: itself
  std::string_view frame_suffix;  ///< empty: any scan
  /// Files to look for in this order, '*' standing for anything at the start; with a pose file a
  /// frame: its folder, and what stands there in place of frame_suffix.
  std::array<std::string_view, 3> pose_files;
  double depth_scale_m;
  LargestValue largest_value;
  std::array<double, 4> fx_fy_cx_cy_px;  ///< zeros: the recording or the user must say
  PoseAxes axes;
};

std::span<const Convention> conventions();
const Convention& convention_of(RecordingFormat format);

}  // namespace nbvopt
